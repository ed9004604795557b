#ifndef impoint_materials_linear_elastic_h
#define impoint_materials_linear_elastic_h

#include <impoint/materials/elastic_moduli.h>
#include <impoint/materials/material.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * Isotropic elasticity of small strains in rate form: the stress grows by
     * D : sym grad of the step's displacement, the geometry stays that of the
     * step's start (I). F isn't looked at: it may be anything.
     */
    template <int dim>
    class LinearElastic : public Material<dim>
    {
    public:
      explicit LinearElastic(const ElasticModuli &moduli);

      bool small_strain() const override
      {
        return true;
      }

      bool constant_tangent() const override
      {
        return true;
      }

      bool starts_from_stress() const override
      {
        return true;
      }

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
      VoigtMatrix<dim>    tangent;
    };
  } // namespace Materials
} // namespace Impoint

#endif
