#include <impoint/enforcement/penalty.h>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // In units of E/h: the largest factor that enters a matrix as it is, and
      // the one that stands for larger ones beside their multipliers. Round-off
      // of the latter in the material's stiffness, 1e-16 of it, stays small.
      constexpr double largest_plain_factor = 1e8;
      constexpr double augmentation_factor  = 1e6;
    } // namespace



    template <int dim>
    Penalty<dim>::Penalty(const ConditionParameters              &parameters,
                          PrescribedMotion<dim>                   motion,
                          std::unique_ptr<BoundaryParticles<dim>> particles,
                          const bool                              projected)
      : GapMethod<dim>(parameters,
                       std::move(motion),
                       std::move(particles),
                       projected)
    {}



    template <int dim>
    TractionLaw Penalty<dim>::law(const unsigned int r, const double area) const
    {
      const double beta = this->factor(r);
      TractionLaw  law;
      law.augmented =
        this->is_linear() && beta > largest_plain_factor * this->unit(r);
      law.gamma =
        law.augmented ?
          this->enlarge(augmentation_factor * this->unit(r), r, area) :
          beta - this->spring(r);
      law.compliance = law.augmented ? 1. / beta : 0.;
      return law;
    }

    template class Penalty<2>;
    template class Penalty<3>;
  } // namespace Enforcement
} // namespace Impoint
