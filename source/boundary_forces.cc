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
  std::vector<Measurements::BoundaryForce<dim>>
  nonconforming_forces(const NonlinearSystem<dim>                  &system,
                       typename NonlinearSystem<dim>::Methods      &methods,
                       const ActiveNodes<dim>                      &active,
                       const typename NonlinearSystem<dim>::Vector &u)
  {
    std::vector<Measurements::BoundaryForce<dim>> nonconforming(methods.size());
    std::vector<double>                           cell_u;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        auto &particles       = methods[m]->particles();
        nonconforming[m].name = particles.name();
        if (methods[m]->is_active())
          methods[m]->end_links([&](const unsigned int   l,
                                    std::vector<double> &link_u) {
            system.gather(active.link(methods[m]->begin_link() + l), u, link_u);
          });
        for (unsigned int r = 0; r < particles.ranges().size(); ++r)
          {
            const auto        &range = particles.ranges()[r];
            const unsigned int k     = active.position(range.cell);
            if (k == BackgroundGrid<dim>::nowhere)
              {
                methods[m]->end_step(r, nullptr);
                continue;
              }
            system.gather(k, u, cell_u);
            if (methods[m]->is_active())
              {
                methods[m]->end_step(r, cell_u.data());
                add_forces(*methods[m], r, cell_u, nonconforming[m]);
              }
            else
              methods[m]->end_step(r, nullptr);
            methods[m]->follow_material(r, cell_u.data());
          }
      }
    return nonconforming;
  }

#define IMPOINT_INSTANTIATE(dim)                                               \
  template std::vector<Measurements::BoundaryForce<dim>> conforming_forces(    \
    const NonlinearSystem<dim> &,                                              \
    const Enforcement::Conforming<dim> &,                                      \
    const ActiveNodes<dim> &,                                                  \
    const NonlinearSystem<dim>::Vector &);                                     \
  template std::vector<Measurements::BoundaryForce<dim>> nonconforming_forces( \
    const NonlinearSystem<dim> &,                                              \
    NonlinearSystem<dim>::Methods &,                                           \
    const ActiveNodes<dim> &,                                                  \
    const NonlinearSystem<dim>::Vector &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
