#include <impoint/boundary_forces.h>
#include <impoint/measurements/totals.h>

namespace Impoint
{
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  conforming_forces(const NonlinearSystem<dim>                  &system,
                    const Enforcement::Conforming<dim>          &conforming,
                    const ActiveNodes<dim>                      &active,
                    const typename NonlinearSystem<dim>::Vector &u)
  {
    std::vector<Measurements::BoundaryForce<dim>> held(
      conforming.n_boundaries());
    for (unsigned int i = 0; i < held.size(); ++i)
      held[i].name = conforming.name(i);
    for (const auto &node : system.held_nodes())
      if (node.node < active.n_owned_nodes())
        {
          Point<dim> x = active.basis().point(active.grid_node(node.node));
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += u.local_element(node.node * dim + d);
          for (unsigned int k = 0; k < node.n_held; ++k)
            {
              const Tensor<1, dim> force = system.reaction(node, k);
              held[node.boundary[k]].force += force;
              held[node.boundary[k]].moment +=
                Measurements::moment<dim>(Tensor<1, dim>(x), force);
            }
        }
    return held;
  }



  namespace
  {
    /** Forces of the particles in range @p r, and their moments where the
     * material is. */
    template <int dim>
    void add_forces(const Enforcement::Method<dim>   &method,
                    const unsigned int                r,
                    const std::vector<double>        &cell_u,
                    Measurements::BoundaryForce<dim> &sum)
    {
      const auto &particles = method.particles();
      const auto &slots     = particles.slots();
      const auto &range     = particles.ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          const Tensor<1, dim> force = particles.vector(b, slots.force);
          sum.force += force;
          sum.moment += Measurements::moment<dim>(
            method.material_place(b, cell_u.size() / dim, cell_u.data()),
            force);
          if (!particles.carried().material)
            continue;
          const double *couple = particles.data(b) + slots.couple;
          for (unsigned int d = 0; d < (dim == 2 ? 1 : 3); ++d)
            sum.moment[dim == 2 ? 2 : d] += couple[d];
        }
    }
  } // namespace



  template <int dim>
  void end_step_of_boundaries(const NonlinearSystem<dim>             &system,
                              typename NonlinearSystem<dim>::Methods &methods,
                              const ActiveNodes<dim>                 &active,
                              const typename NonlinearSystem<dim>::Vector &u)
  {
    std::vector<double> cell_u;
    for (const auto &method : methods)
      {
        const bool acts = method->is_active();
        if (acts)
          method->end_links(
            [&](const unsigned int l, std::vector<double> &link_u) {
              system.gather(active.link(method->begin_link() + l), u, link_u);
            });
        const auto &ranges = method->particles().ranges();
        for (unsigned int r = 0; r < ranges.size(); ++r)
          {
            const unsigned int k         = active.position(ranges[r].cell);
            const bool         is_active = k != BackgroundGrid<dim>::nowhere;
            if (is_active)
              system.gather(k, u, cell_u);
            method->end_step(r, acts && is_active ? cell_u.data() : nullptr);
            if (is_active)
              method->follow_material(r, cell_u.data());
          }
      }
  }



  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  nonconforming_forces(const NonlinearSystem<dim>                   &system,
                       const typename NonlinearSystem<dim>::Methods &methods,
                       const ActiveNodes<dim>                       &active,
                       const typename NonlinearSystem<dim>::Vector  &u)
  {
    std::vector<Measurements::BoundaryForce<dim>> forces(methods.size());
    std::vector<double>                           cell_u;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        forces[m].name = methods[m]->particles().name();
        if (methods[m]->is_active())
          Enforcement::for_active_ranges(
            *methods[m],
            active,
            [&](const unsigned int r, const unsigned int k) {
              system.gather(k, u, cell_u);
              add_forces(*methods[m], r, cell_u, forces[m]);
            });
      }
    return forces;
  }



  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  balanced_forces(const NonlinearSystem<dim>                   &system,
                  const typename NonlinearSystem<dim>::Methods &methods,
                  const ActiveNodes<dim>                       &active,
                  const typename NonlinearSystem<dim>::Vector  &u)
  {
    using Enforcement::Strength;
    std::vector<Measurements::BoundaryForce<dim>> forces(methods.size());
    std::vector<double>                           cell_u, residual, matrix;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        const Enforcement::Method<dim> &method = *methods[m];
        // loads, and multipliers that were found
        const auto *multipliers = methods[m]->multiplier_updates();
        const bool  acts_at_rest =
          !method.constrains() || (multipliers && multipliers->augmented());
        // Shape functions sum to one: so do the nodes' shares of a force. It is
        // linear, as in the balance.
        const auto subtract = [&](const unsigned int k,
                                  const auto        &contribute) {
          system.gather(k, u, cell_u);
          const unsigned int        n = cell_u.size();
          const std::vector<double> zero(n, 0.);
          residual.assign(n, 0.);
          matrix.assign(n * n, 0.);
          CellSystem cell = {n / dim,
                             zero.data(),
                             residual.data(),
                             matrix.data()};
          contribute(cell);
          const double *entry = matrix.data();
          for (unsigned int ab = 0; ab < cell.n * cell.n; ++ab)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                forces[m].force[i] -= *entry++ * cell_u[ab % cell.n * dim + j];
          if (acts_at_rest)
            for (unsigned int i = 0; i < n; ++i)
              forces[m].force[i % dim] -= residual[i];
        };
        forces[m].name = method.particles().name();
        if (!method.is_active())
          continue;
        Enforcement::for_active_ranges(
          method, active, [&](const unsigned int r, const unsigned int k) {
            subtract(k, [&](CellSystem &cell) {
              method.add(r, Strength::constraint, cell);
            });
          });
        Enforcement::for_links(
          method, active, [&](const unsigned int l, const unsigned int k) {
            subtract(k, [&](CellSystem &cell) {
              method.add_link(l, Strength::constraint, cell);
            });
          });
      }
    return forces;
  }

#define IMPOINT_INSTANTIATE(dim)                                               \
  template std::vector<Measurements::BoundaryForce<dim>> conforming_forces(    \
    const NonlinearSystem<dim> &,                                              \
    const Enforcement::Conforming<dim> &,                                      \
    const ActiveNodes<dim> &,                                                  \
    const NonlinearSystem<dim>::Vector &);                                     \
  template void end_step_of_boundaries(const NonlinearSystem<dim> &,           \
                                       NonlinearSystem<dim>::Methods &,        \
                                       const ActiveNodes<dim> &,               \
                                       const NonlinearSystem<dim>::Vector &);  \
  template std::vector<Measurements::BoundaryForce<dim>> nonconforming_forces( \
    const NonlinearSystem<dim> &,                                              \
    const NonlinearSystem<dim>::Methods &,                                     \
    const ActiveNodes<dim> &,                                                  \
    const NonlinearSystem<dim>::Vector &);                                     \
  template std::vector<Measurements::BoundaryForce<dim>> balanced_forces(      \
    const NonlinearSystem<dim> &,                                              \
    const NonlinearSystem<dim>::Methods &,                                     \
    const ActiveNodes<dim> &,                                                  \
    const NonlinearSystem<dim>::Vector &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
