#include <impoint/base/on_all_ranks.h>
#include <impoint/terms/body_force.h>

#include <algorithm>

namespace Impoint
{
  using NodalVector = LinearAlgebra::distributed::Vector<double>;

  template <int dim>
  NodalVector body_force(const MaterialPoints<dim>        &points,
                         const ActiveNodes<dim>           &active,
                         const std::vector<BodyLoad<dim>> &body_loads,
                         const double                      at,
                         const NodalVector                *masses)
  {
    NodalVector forces(active.unknowns());
    if (std::all_of(body_loads.begin(), body_loads.end(), [](const auto &load) {
          return load.per_mass.is_zero();
        }))
      return forces;
    const unsigned int          mass = points.slots().mass;
    std::vector<Tensor<1, dim>> uniform;
    bool                        everywhere = masses != nullptr;
    for (const auto &load : body_loads)
      {
        uniform.push_back(load.per_mass.is_constant() ?
                            load.per_mass.vector({}, at) :
                            Tensor<1, dim>());
        everywhere = everywhere && load.per_mass.is_constant() &&
                     uniform.back() == uniform.front();
      }
    if (everywhere)
      {
        for (unsigned int i = 0; i < active.n_owned_nodes(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            forces.local_element(i * dim + d) =
              masses->local_element(i) * uniform.front()[d];
        return forces;
      }
    const auto place = [&](const unsigned int p, const unsigned int body) {
      return body_loads[body].of_start ?
               points.position(p) - points.vector(p, points.slots().u) :
               points.position(p);
    };
    std::vector<double> cell_forces;
    on_all_ranks(active.basis().grid().communicator(), [&]() {
      for (unsigned int k = 0; k < active.n_material_cells(); ++k)
        {
          const auto  nodes = active.nodes(k);
          const auto &range = points.ranges()[k];
          cell_forces.assign(nodes.size() * dim, 0.);
          for (unsigned int p = range.begin; p < range.end; ++p)
            {
              const unsigned int   body  = points.body(p);
              const auto          &force = body_loads[body].per_mass;
              const double        *N     = points.support(p);
              const Tensor<1, dim> load =
                points.data(p)[mass] * (force.is_constant() ?
                                          uniform[body] :
                                          force.vector(place(p, body), at));
              for (unsigned int a = 0; a < nodes.size(); ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  cell_forces[a * dim + d] += N[a] * load[d];
            }
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              forces.local_element(nodes[a] * dim + d) +=
                cell_forces[a * dim + d];
        }
    });
    forces.compress(VectorOperation::add);
    return forces;
  }

  template NodalVector body_force(const MaterialPoints<2> &,
                                  const ActiveNodes<2> &,
                                  const std::vector<BodyLoad<2>> &,
                                  const double,
                                  const NodalVector *);
  template NodalVector body_force(const MaterialPoints<3> &,
                                  const ActiveNodes<3> &,
                                  const std::vector<BodyLoad<3>> &,
                                  const double,
                                  const NodalVector *);
} // namespace Impoint
