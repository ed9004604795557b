#include <impoint/solver/method_of_multipliers.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    /** a += factor b, per method. */
    void add(std::vector<std::vector<double>>       &a,
             const double                            factor,
             const std::vector<std::vector<double>> &b)
    {
      for (unsigned int m = 0; m < a.size(); ++m)
        for (unsigned int i = 0; i < a[m].size(); ++i)
          a[m][i] += factor * b[m][i];
    }
  } // namespace



  template <int dim>
  MethodOfMultipliers<dim>::MethodOfMultipliers(
    Assembly<dim>             &assembly,
    Enforcement::Methods<dim> &methods,
    const Solve               &solve)
    : assembly(assembly)
    , methods(methods)
    , solve(solve)
  {}



  template <int dim>
  typename MethodOfMultipliers<dim>::Multipliers
  MethodOfMultipliers<dim>::get() const
  {
    Multipliers values;
    for (const auto &method : methods)
      values.push_back(method->is_active() && method->multiplier_updates() ?
                         method->multiplier_updates()->multipliers() :
                         std::vector<double>());
    return values;
  }



  template <int dim>
  void MethodOfMultipliers<dim>::set(const Multipliers &values)
  {
    for (unsigned int m = 0; m < values.size(); ++m)
      if (auto *updates = methods[m]->multiplier_updates())
        updates->set_multipliers(values[m]);
  }



  template <int dim>
  typename MethodOfMultipliers<dim>::Multipliers
  MethodOfMultipliers<dim>::update(const Vector &place, Vector &forces)
  {
    const Multipliers present = get();
    assembly.update_multipliers(place, forces);
    Multipliers change = get();
    set(present);
    add(change, -1., present);
    return change;
  }



  /** The direction of the next update, @p step with @p forces from the @p
   * present multipliers and delta: its effect is at right angles to that of all
   * before. */
  template <int dim>
  typename MethodOfMultipliers<dim>::Direction
  MethodOfMultipliers<dim>::next_direction(
    const Vector                 &place,
    const Multipliers            &present,
    const Multipliers            &step,
    const Vector                 &forces,
    const double                  looser,
    const double                  further,
    const std::vector<Direction> &directions)
  {
    Direction p;
    p.multipliers = step;
    p.forces      = forces;
    Vector right(forces);
    right *= -1.;
    p.displacements.reinit(place);
    solve(right, looser, further, p.displacements);

    Multipliers trial = present;
    add(trial, 1., p.multipliers);
    set(trial);
    Vector trial_place(place);
    trial_place += p.displacements;
    trial_place.update_ghost_values();
    p.update = update(trial_place, p.effect);
    add(p.update, -1., step);
    p.effect -= forces;

    for (const Direction &q : directions)
      {
        const double part = -(p.effect * q.effect) / q.effect.norm_sqr();
        add(p.multipliers, part, q.multipliers);
        add(p.update, part, q.update);
        p.forces.add(part, q.forces);
        p.displacements.add(part, q.displacements);
        p.effect.add(part, q.effect);
      }
    return p;
  }



  template <int dim>
  typename MethodOfMultipliers<dim>::Vector
  MethodOfMultipliers<dim>::find(const Vector &u,
                                 const double  load,
                                 const double  reference,
                                 const double  round_off,
                                 const bool    exact,
                                 Vector       &delta)
  {
    constexpr double tolerance = 1e-13, coarse = 1e-4;
    // What is left and hardly falls, and is as small as round-off of the
    // forces, is that.
    constexpr double small = 4., falls = 0.5;
    // energy of what is left, where a further correction follows
    constexpr double       coarse_solution = 1e4;
    constexpr unsigned int max_solutions = 100, most_idle = 6;
    // A combination of multipliers that answers less than this part of itself
    // is one of constraints that depend on each other, but for round-off.
    constexpr double dependent = 1e-10;
    before                     = get();
    Multipliers present        = before;
    Vector      place(u), forces, total(u.get_partitioner());
    place += delta;
    place.update_ghost_values();
    Multipliers            step = update(place, forces);
    std::vector<Direction> directions;
    unsigned int           n_idle = 0;
    double                 rest   = forces.l2_norm();
    largest                       = std::max({largest, load, rest});
    const double enough           = exact ? 0. : coarse * reference;
    // Directions that lessen next to nothing may be long, and what their
    // displacements lack in accuracy with them: they are taken back at the end.
    struct
    {
      double      rest;
      Multipliers multipliers;
      Vector      delta, place, total;
    } paid = {rest, present, delta, place, total};
    while (directions.size() < max_solutions && rest > enough &&
           rest > tolerance * largest)
      {
        directions.push_back(next_direction(place,
                                            present,
                                            step,
                                            forces,
                                            std::max(1., reference / rest),
                                            exact ? 1. : coarse_solution,
                                            directions));
        const Direction &p      = directions.back();
        const double     length = p.effect.norm_sqr();
        if (length <= dependent * dependent * p.forces.norm_sqr() ||
            p.displacements.l2_norm() == 0.)
          break;
        const double part = -(forces * p.effect) / length;
        add(present, part, p.multipliers);
        add(step, part, p.update);
        delta.add(part, p.displacements);
        place.add(part, p.displacements);
        total.add(part, p.forces);
        forces.add(part, p.effect);

        const double last = rest;
        rest              = forces.l2_norm();
        if (rest <= falls * paid.rest)
          paid = {rest, present, delta, place, total};
        largest = std::max(largest, total.l2_norm());
        n_idle  = rest > 0.999 * last ? n_idle + 1 : 0;
        if (n_idle == most_idle ||
            (rest > falls * last && rest <= small * round_off))
          break;
      }
    if (rest > std::max(enough, falls * paid.rest))
      {
        present = paid.multipliers;
        delta   = paid.delta;
        place   = paid.place;
        total   = paid.total;
      }
    set(present);
    if (std::any_of(methods.begin(), methods.end(), [](const auto &method) {
          return method->is_active() && !method->is_symmetric();
        }))
      {
        // What slides leaves the part of its multiplier along the wall unseen
        // in all residuals above, so that it may be anything.
        assembly.update_multipliers(place, forces);
        total += forces;
      }
    after = get();
    delta.update_ghost_values();
    return total;
  }



  template <int dim>
  void MethodOfMultipliers<dim>::begin_step()
  {
    largest = 0;
  }



  template <int dim>
  void MethodOfMultipliers<dim>::cut(const double fraction)
  {
    if (before.empty() || fraction == 1.)
      return;
    Multipliers values = before;
    add(values, fraction, after);
    add(values, -fraction, before);
    set(values);
  }

  template class MethodOfMultipliers<2>;
  template class MethodOfMultipliers<3>;
} // namespace Impoint
