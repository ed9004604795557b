#ifndef impoint_enforcement_penalty_h
#define impoint_enforcement_penalty_h

#include <impoint/enforcement/gap_method.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Penalty on the gap: traction t = beta g (P Eqs. 42-43; slip: Eqs. 45-50),
     * on each particle's gap or, projected, on the mean gap of a cell, which
     * tends to the solution with one multiplier a cell and does not lock.
     *
     * Where beta exceeds 1e8 E/h the same traction is found with a multiplier
     * of compliance 1/beta (perturbed Lagrangian). Contact, whose
     * Newton iteration has kinks, takes beta as it is: 10 to 100 E/h are enough
     * for a penetration far below the resolution, and converge.
     */
    template <int dim>
    class Penalty : public GapMethod<dim>
    {
    public:
      Penalty(const ConditionParameters              &parameters,
              PrescribedMotion<dim>                   motion,
              std::unique_ptr<BoundaryParticles<dim>> particles,
              const bool                              projected);

    private:
      TractionLaw law(const unsigned int r, const double area) const override;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
