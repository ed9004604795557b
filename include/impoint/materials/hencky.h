#ifndef impoint_materials_hencky_h
#define impoint_materials_hencky_h

#include <impoint/materials/elastic_moduli.h>
#include <impoint/materials/material.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * The linear law between Kirchhoff stress and logarithmic strain:
     * tau = lambda tr eps 1 + 2 mu eps, eps = 1/2 ln b.
     */
    template <int dim>
    class Hencky : public Material<dim>
    {
    public:
      explicit Hencky(const ElasticModuli &moduli);

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
      /** Spatial tangent from the principal values of b - 1 and of tau. */
      VoigtMatrix<dim> tangent(const Spectrum<dim>           &b_minus_one,
                               const std::array<double, dim> &tau) const;

      const ElasticModuli moduli;
    };
  } // namespace Materials
} // namespace Impoint

#endif
