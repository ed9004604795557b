#ifndef impoint_enforcement_lagrange_multiplier_h
#define impoint_enforcement_lagrange_multiplier_h

#include <impoint/enforcement/gap_method.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * One constant multiplier vector per cut cell (L Eqs. 26-29; slip: its
     * normal component, Eq. 35), found without a saddle point: an augmented
     * Lagrangian on the cell's mean gap, whose solution does not depend on the
     * factor gamma.
     *
     * Both enforcements of this kind differ in who chooses gamma. Where there
     * are more cells than displacements can follow, neighbours share one (L
     * Section 3.2.2 leaves some out).
     */
    template <int dim>
    class LagrangeMultiplier : public GapMethod<dim>
    {
    public:
      LagrangeMultiplier(const ConditionParameters              &parameters,
                         PrescribedMotion<dim>                   motion,
                         std::unique_ptr<BoundaryParticles<dim>> particles,
                         const bool user_chooses_factor);

    private:
      TractionLaw law(const unsigned int r, const double area) const override;

      /** The rule of L Section 3.7: in cells that the boundary cuts near a
       * vertex or along a face, so that no particle sees some node. */
      bool raises_small_values(const unsigned int r) const override;

      const bool user_chooses_factor;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
