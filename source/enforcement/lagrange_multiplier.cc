#include <impoint/enforcement/lagrange_multiplier.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // In units of E/h. A linear solve reduces the gap by this factor, and
      // looses its reciprocal in digits of the material's stiffness.
      // Contact is content with a smaller one; less would leave cells with
      // little material to the few combinations of multipliers that are looked
      // for.
      // With friction round-off of the gap beside a large factor would decide
      // on what sticks and slides.
      constexpr double best_factor = 1e6, best_factor_of_contact = 1e4,
                       best_factor_of_friction = 1e2;
    } // namespace



    template <int dim>
    LagrangeMultiplier<dim>::LagrangeMultiplier(
      const ConditionParameters              &parameters,
      PrescribedMotion<dim>                   motion,
      std::unique_ptr<BoundaryParticles<dim>> particles,
      const bool                              user_chooses_factor)
      : GapMethod<dim>(parameters,
                       std::move(motion),
                       std::move(particles),
                       true)
      , user_chooses_factor(user_chooses_factor)
    {}



    template <int dim>
    TractionLaw LagrangeMultiplier<dim>::law(const unsigned int r,
                                             const double       area) const
    {
      TractionLaw law;
      law.augmented = true;
      if (user_chooses_factor)
        law.gamma = this->factor(r);
      else if (!this->is_linear())
        law.gamma = (this->is_symmetric() ? best_factor_of_contact :
                                            best_factor_of_friction) *
                    this->unit(r);
      else
        law.gamma = best_factor * this->unit(r);
      if (this->is_linear())
        law.gamma = this->enlarge(law.gamma, r, area);
      return law;
    }



    template <int dim>
    bool
    LagrangeMultiplier<dim>::raises_small_values(const unsigned int r) const
    {
      if (!this->condition.small_cut_rule)
        return false;
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n =
        this->current.active->basis().n_nodes_of(range.cell);
      for (unsigned int a = 0; a < n; ++a)
        {
          double largest = 0;
          for (unsigned int b = range.begin; b < range.end; ++b)
            largest = std::max(largest, this->boundary->support(b)[a]);
          if (largest <= this->small_cut_value)
            return true;
        }
      return false;
    }

    template class LagrangeMultiplier<2>;
    template class LagrangeMultiplier<3>;
  } // namespace Enforcement
} // namespace Impoint
