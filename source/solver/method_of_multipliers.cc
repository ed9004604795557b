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
      values.push_back(method->is_active() ? method->multipliers() :
                                             std::vector<double>());
    return values;
  }



  template <int dim>
  void MethodOfMultipliers<dim>::set(const Multipliers &values)
  {
    for (unsigned int m = 0; m < values.size(); ++m)
      methods[m]->set_multipliers(values[m]);
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



  template <int dim>
  typename MethodOfMultipliers<dim>::Vector
  MethodOfMultipliers<dim>::find(const Vector &u,
                                 const double  smallest,
                                 const double  reference,
                                 Vector       &delta)
  {
    constexpr unsigned int max_solutions = 40;
    before                               = get();
    Multipliers present                  = before;
    Vector      place(u), forces, total;
    total.reinit(u);
    place += delta;
    place.update_ghost_values();
    Multipliers            step = update(place, forces);
    std::vector<Direction> directions;
    double                 last = forces.l2_norm();
    for (unsigned int n = 0; n < max_solutions && last > smallest; ++n)
      {
        Direction p;
        p.multipliers = step;
        p.forces      = forces;
        Vector right(forces);
        right *= -1.;
        p.displacements.reinit(u);
        solve(right, std::max(1., reference / last), p.displacements);

        Multipliers trial = present;
        add(trial, 1., p.multipliers);
        set(trial);
        place = u;
        place += delta;
        place += p.displacements;
        place.update_ghost_values();
        p.update = update(place, p.effect);
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
        const double length = p.effect.norm_sqr();
        if (length == 0)
          break;
        const double part = -(forces * p.effect) / length;
        add(present, part, p.multipliers);
        add(step, part, p.update);
        delta.add(part, p.displacements);
        total.add(part, p.forces);
        forces.add(part, p.effect);
        directions.push_back(std::move(p));

        const double size  = forces.l2_norm();
        const bool   stuck = size > 0.999 * last; // round-off
        last               = size;
        if (stuck)
          break;
      }
    set(present);
    after = present;
    delta.update_ghost_values();
    return total;
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
