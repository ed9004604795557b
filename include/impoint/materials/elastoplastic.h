#ifndef impoint_materials_elastoplastic_h
#define impoint_materials_elastoplastic_h

#include <impoint/materials/material.h>
#include <impoint/materials/yield_surface.h>

namespace Impoint
{
  namespace Materials
  {
    /** Exponential decay of strength with the equivalent plastic strain kappa:
     * residual + (1 - residual) exp(-kappa / strain). */
    struct Softening
    {
      double residual = 1; // part that is left in the end; 1: no softening
      double strain   = 1; // plastic strain of decay

      double strength(const double plastic_strain) const;
    };

    /**
     * Finite-strain plasticity of an isotropic yield surface: Hencky's
     * elasticity, a multiplicative split, and a return mapping in principal
     * logarithmic strains that has the form of small strains.
     *
     * A point remembers b - 1, the elastic left Cauchy-Green tensor without 1
     * (tensor components; in 2D then zz, which plane strain keeps), the
     * equivalent plastic strain, and the volume strain by which it was torn
     * open at the apex. F itself isn't looked at. What softens has the strength
     * that it had at the start of the step.
     *
     * If it closes gaps, what was torn open bears no pressure before it is
     * closed (A. Tampubolon et al., Multi-species simulation of porous sand and
     * water mixtures, ACM Trans. Graph. 36, 2017). Otherwise the volume of
     * flowing sand grows for ever: each return to the apex forgets a bit.
     */
    template <int dim>
    class Elastoplastic : public Material<dim>
    {
    public:
      Elastoplastic(const ElasticModuli                &moduli,
                    std::unique_ptr<const YieldSurface> surface,
                    const Softening                    &softening,
                    const bool                          closes_gaps);

      bool symmetric_tangent() const override
      {
        return surface->associated();
      }

      bool starts_from_stress() const override
      {
        return true;
      }

      unsigned int n_history() const override
      {
        return n_elastic + 2;
      }

      /** The elastic state of @p initial, whether or not the material can bear
       * it: the first step returns it. */
      void initialise(const Response<dim> &initial,
                      double              *history) const override;

      double plastic_strain(const double *history) const override
      {
        return history[n_elastic];
      }

      void respond(const Deformation<dim> &deformation,
                   const double           *old_history,
                   double                 *history,
                   const bool              tangent_wanted,
                   Response<dim>          &response) const override;

      VoigtMatrix<dim> elastic_tangent() const override
      {
        VoigtMatrix<dim> result;
        set_elastic_matrix<dim>(moduli.lambda, moduli.mu, result);
        return result;
      }

      double young() const override
      {
        return moduli.young;
      }

      /** The elastic part. */
      double energy(const Deformation<dim> &deformation,
                    const Response<dim>    &response) const override;

    protected:
      static constexpr int n_elastic = Voigt<dim>::n + (dim == 2 ? 1 : 0);

      /** Logarithmic strains of the trial state. */
      std::array<double, 3> trial_strain(const Spectrum<dim> &b_minus_one,
                                         const double b_zz_minus_one) const;

      /** Trial b - 1: b of the history, stretched by the step. */
      VoigtVector<dim> trial_b(const Tensor<2, dim> &grad_increment,
                               const double         *old_history) const;

      /** Elastic strains as b - 1; adds what has become plastic. */
      void store(const std::array<double, 3> &elastic,
                 const std::array<double, 3> &trial,
                 const Tensor<2, dim>        &directions,
                 double                      *history) const;

      VoigtMatrix<dim> tangent(const Spectrum<dim>   &b_minus_one,
                               const PrincipalReturn &result) const;

      const ElasticModuli                       moduli;
      const std::unique_ptr<const YieldSurface> surface;
      const Softening                           softening;
      const bool                                closes_gaps;
    };
  } // namespace Materials
} // namespace Impoint

#endif
