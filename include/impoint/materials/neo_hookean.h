#ifndef impoint_materials_neo_hookean_h
#define impoint_materials_neo_hookean_h

#include <impoint/materials/elastic_moduli.h>
#include <impoint/materials/material.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * Compressible neo-Hookean solid tau = mu (b - 1) + lambda ln J 1 with
     * energy mu/2 (tr b - 3) - mu ln J + lambda/2 (ln J)^2.
     */
    template <int dim>
    class NeoHookean : public Material<dim>
    {
    public:
      explicit NeoHookean(const ElasticModuli &moduli);

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
