#include <impoint/enforcement/gap_method.h>
#include <impoint/enforcement/superfluous_constraints.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    GapMethod<dim>::GapMethod(const ConditionParameters &parameters,
                              PrescribedMotion<dim>      motion,
                              std::unique_ptr<BoundaryParticles<dim>> particles,
                              const bool                              projected)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , projected(projected)
      , normal_only(parameters.constraint == Constraint::slip &&
                    parameters.friction == 0)
      , factor_has_unit(parameters.factor_is_absolute)
    {}



    template <int dim>
    double GapMethod<dim>::unit(const unsigned int r) const
    {
      return this->current.stiffness->young(this->boundary->ranges()[r].cell) /
             sizes[r];
    }



    template <int dim>
    double GapMethod<dim>::factor(const unsigned int r) const
    {
      return factor_has_unit ? this->condition.factor :
                               this->condition.factor * unit(r);
    }



    template <int dim>
    double GapMethod<dim>::enlarge(const double       gamma,
                                   const unsigned int r,
                                   const double       area) const
    {
      return gamma *
             std::max(1.,
                      this->boundary->thickness() *
                        Utilities::fixed_power<dim - 1>(sizes[r]) / area);
    }



    template <int dim>
    bool GapMethod<dim>::takes_part(const unsigned int r) const
    {
      return (left_out.empty() || !left_out[r]) &&
             this->boundary->held_area_of_range(r) > 0;
    }



    template <int dim>
    bool GapMethod<dim>::removes_superfluous() const
    {
      return !this->condition.releasing &&
             this->condition.superfluous == Superfluous::remove;
    }



    template <int dim>
    bool GapMethod<dim>::is_linear() const
    {
      return !this->condition.releasing && this->condition.friction == 0;
    }



    template <int dim>
    bool GapMethod<dim>::is_symmetric() const
    {
      return friction() < 0;
    }



    /** Coefficient of friction; negative where nothing bounds the traction
     * along the wall. What sticks until it lets go would drop that traction in
     * one jump: the equations of a step may have no solution where it pulls
     * the material off the wall, and Newton's iteration then goes back and
     * forth between the two for ever. A bound that closes with the pressure
     * makes the traction continuous. */
    template <int dim>
    double GapMethod<dim>::friction() const
    {
      constexpr double firm_grip = 10;
      const auto      &condition = this->condition;
      if (condition.constraint == Constraint::slip)
        return normal_only ? -1. : condition.friction;
      return condition.releasing ? firm_grip : -1.;
    }



    template <int dim>
    bool GapMethod<dim>::augmented() const
    {
      for (unsigned int r = 0; r < this->boundary->ranges().size(); ++r)
        if (law(r, 1.).augmented) // whatever the area
          return true;
      return false;
    }



    template <int dim>
    void GapMethod<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      sizes.clear();
      for (const auto &range : this->boundary->ranges())
        sizes.push_back(step.active->basis().grid().size(range.cell));
      jumps.clear();
      if (!this->active_now)
        return;
      frozen = false;
      contacts.assign(this->boundary->n(), {});
      first_contacts = contacts;
      multiplier.resize(this->boundary->n());
      for (unsigned int b = 0; b < multiplier.size(); ++b)
        multiplier[b] =
          this->boundary->vector(b, this->boundary->slots().multiplier);
      // The mean of n . g in a cell is one condition whatever its normals, and
      // a turn about the centre of a circle leaves it zero. One of averaged
      // normals does not, and its force has a moment about that centre.
      const auto choice   = this->condition.normals;
      const bool one_mean = projected && !shares_constraints();
      if (normal_only)
        normals.reinit(one_mean && choice == Normals::automatic ?
                         Normals::particle :
                         choice,
                       *this,
                       *step.active);
      if (this->condition.releasing)
        {
          near.resize(this->boundary->n());
          for (unsigned int b = 0; b < near.size(); ++b)
            near[b] = is_closed(b);
          proximity = distances(*this->boundary,
                                near,
                                step.active->basis().grid(),
                                *step.points);
          // without material before it nothing is held
          const double h = step.active->basis().grid().smallest_size();
          for (unsigned int b = 0; b < near.size(); ++b)
            near[b] =
              proximity[b].edge <= 0 || (near[b] && proximity[b].edge < h);
        }
      left_out.clear();
      if (removes_superfluous())
        left_out = superfluous_constraints(*this->boundary, *step.active);
      if (stabilises())
        {
          jumps.reinit(*this->boundary,
                       *step.active,
                       this->condition.jump_penalty,
                       step.stiffness->largest_young(this->boundary->ranges()));
          tell_multipliers();
        }
      make_link_patches();
    }



    template <int dim>
    bool GapMethod<dim>::raises_small_values(const unsigned int) const
    {
      return this->condition.small_cut_rule;
    }



    template <int dim>
    template <typename Function>
    void GapMethod<dim>::for_patches(const unsigned int r,
                                     const Function    &function) const
    {
      if (!takes_part(r) || shared.contains(r))
        return;
      const auto &range = this->boundary->ranges()[r];
      if (projected)
        function(make_patch(r, range.begin, range.end));
      else
        for (unsigned int b = range.begin; b < range.end; ++b)
          if (this->boundary->held_area(b) > 0)
            function(make_patch(r, b, b + 1));
    }



    /** @p r: the range whose stiffness E/h is the patch's. */
    template <int dim>
    void GapMethod<dim>::add_patch(const Patch                  &patch,
                                   const typename Patch::Answer &answer,
                                   const unsigned int            r,
                                   const Strength                strength,
                                   CellSystem                   &system) const
    {
      patch.add_force(answer.traction, system);
      if (system.matrix == nullptr)
        return;
      const double part =
        strength == Strength::moderate ?
          std::min(1., moderate_factor * unit(r) / patch.law.stiffness()) :
          1.;
      patch.add_stiffness(part * patch.law.stiffness() * answer.slope, system);
    }



    template <int dim>
    void GapMethod<dim>::add(const unsigned int r,
                             const Strength     strength,
                             CellSystem        &system) const
    {
      for_patches(r, [&](const Patch &patch) {
        add_patch(patch, answer(patch, system.u), r, strength, system);
      });
      add_springs(r, strength, system);
    }



    template <int dim>
    void GapMethod<dim>::update_multipliers(const unsigned int r,
                                            CellSystem        &system)
    {
      for_patches(r, [&](Patch patch) {
        if (!patch.law.augmented)
          return;
        const Tensor<1, dim> t = linear_traction(patch, system.u);
        for (unsigned int b = patch.begin; b < patch.end; ++b)
          multiplier[b] = t;
        patch.multiplier = t;
        patch.add_force(linear_traction(patch, system.u) - t, system);
      });
    }



    template <int dim>
    std::vector<double> GapMethod<dim>::multipliers() const
    {
      std::vector<double> values;
      if (augmented())
        {
          const auto append = [&](const Tensor<1, dim> &lambda) {
            values.insert(values.end(), lambda.begin_raw(), lambda.end_raw());
          };
          for (const Tensor<1, dim> &lambda : multiplier)
            append(lambda);
          for (const Patch &patch : link_patches)
            append(patch.multiplier);
        }
      return values;
    }



    template <int dim>
    void GapMethod<dim>::set_multipliers(const std::vector<double> &values)
    {
      for (unsigned int i = 0; i < values.size(); ++i)
        {
          const unsigned int k = i / dim, n = multiplier.size();
          (k < n ? multiplier[k] : link_patches[k - n].multiplier)[i % dim] =
            values[i];
        }
      if (jumps.acts())
        tell_multipliers();
    }



    /** What does not touch has no multiplier. */
    template <int dim>
    void GapMethod<dim>::begin_correction()
    {
      first_contacts = contacts;
      if (!this->condition.releasing)
        return; // all touches
      for (Patch &patch : link_patches)
        if (contacts[patch.begin].touch == Touch::open)
          patch.multiplier = Tensor<1, dim>();
      for_active_ranges(*this,
                        *this->current.active,
                        [&](const unsigned int r, const unsigned int) {
                          for_patches(r, [&](const Patch &patch) {
                            if (contacts[patch.begin].touch == Touch::open)
                              std::fill(multiplier.begin() + patch.begin,
                                        multiplier.begin() + patch.end,
                                        Tensor<1, dim>());
                          });
                        });
    }



    template <int dim>
    void GapMethod<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto &slots = this->boundary->slots();
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        for (const unsigned int slot : {slots.force, slots.multiplier})
          this->boundary->set_vector(b, slot, Tensor<1, dim>());
      if (u != nullptr && shared.contains(r))
        {
          typename Patch::Answer answer;
          answer.traction = shared_tractions[r];
          Patch patch     = make_patch(r, range.begin, range.end);
          patch.reach     = shared_reaches[r];
          return store(r, u, patch, answer, shared_gaps[r]);
        }
      if (u != nullptr && takes_part(r))
        return for_patches(r, [&](const Patch &patch) {
          // neighbours' multipliers shift it anew in the next step
          store(r, u, patch, answer(patch, u), patch.gap(u) - jumps.shift(r));
        });
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          Tensor<1, dim> gap; // none to what comes here next
          if (u != nullptr)
            gap = alone(r, b).gap(u);
          this->boundary->set_vector(b, slots.gap, gap);
        }
    }



    /** What holds remembers the gap that it acts on, without springs @p
     * common_gap: how their own gaps differ is never corrected then, grows
     * where the material flows along the wall, and would be a sudden gap of the
     * next cell that some of them come to. */
    template <int dim>
    void GapMethod<dim>::store(const unsigned int            r,
                               const double                 *u,
                               const Patch                  &patch,
                               const typename Patch::Answer &answer,
                               const Tensor<1, dim>         &common_gap)
    {
      const auto  &slots = this->boundary->slots();
      const Touch  touch = contacts[patch.begin].touch;
      const double k     = spring(r);
      for (unsigned int b = patch.begin; b < patch.end; ++b)
        {
          const Patch    alone = this->alone(r, b);
          Tensor<1, dim> gap   = k > 0 ? alone.gap(u) : common_gap;
          if (touch == Touch::open || !is_in(patch, b))
            gap = Tensor<1, dim>();
          else if (touch == Touch::slides)
            {
              // along the wall, what the spring of a penalty goes on holding
              const Tensor<1, dim> along =
                answer.traction -
                (answer.traction * patch.normal) * patch.normal;
              gap = (gap * patch.normal) * patch.normal;
              if (!patch.law.augmented)
                gap += along / patch.law.gamma;
            }
          // what the wall does to the material is minus what the residual holds
          const Tensor<1, dim> force = this->boundary->held_area(b) *
                                       alone.total(answer.traction + k * gap);
          this->boundary->set_vector(b, slots.gap, gap);
          if (!is_in(patch, b))
            continue;
          this->boundary->set_vector(b, slots.force, -force);
          if (patch.law.augmented)
            this->boundary->set_vector(b, slots.multiplier, answer.traction);
        }
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
