#ifndef impoint_materials_st_venant_kirchhoff_h
#define impoint_materials_st_venant_kirchhoff_h

#include <impoint/materials/elastic_moduli.h>
#include <impoint/materials/material.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * S = lambda tr E 1 + 2 mu E with Green's strain E, tau = F S F^T. For
     * moderate strains: softens in compression and fails below a stretch of
     * 1/sqrt(3).
     */
    template <int dim>
    class StVenantKirchhoff : public Material<dim>
    {
    public:
      explicit StVenantKirchhoff(const ElasticModuli &moduli);

      void respond(const Deformation<dim> &deformation,
                   const double           *old_history,
                   double                 *history,
                   const bool              tangent_wanted,
                   Response<dim>          &response) const override;

      double young() const override
      {
        return moduli.young;
      }

      double energy(const Deformation<dim> &deformation,
                    const Response<dim>    &response) const override;

    private:
      const ElasticModuli moduli;
    };
  } // namespace Materials
} // namespace Impoint

#endif
