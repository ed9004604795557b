#ifndef impoint_enforcement_traction_h
#define impoint_enforcement_traction_h

#include <impoint/enforcement/enforcement.h>

namespace Impoint
{
  namespace Enforcement
  {
    /** Load per initial area on the boundary particles: the last term of P
     * Eq. 15. */
    template <int dim>
    class Traction : public Method<dim>
    {
    public:
      Traction(const ConditionParameters              &parameters,
               PrescribedMotion<dim>                   motion,
               std::unique_ptr<BoundaryParticles<dim>> particles,
               Expression<dim>                         traction);

      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      void end_step(const unsigned int r, const double *u) override;
      bool constrains() const override
      {
        return false;
      }

    private:
      Tensor<1, dim> force(const unsigned int b) const;

      Expression<dim> traction;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
