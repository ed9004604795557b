#include <impoint/base/on_all_ranks.h>
#include <impoint/terms/body_force.h>

namespace Impoint
{
  template <int dim>
  LinearAlgebra::distributed::Vector<double>
  body_force(const MaterialPoints<dim>          &points,
             const ActiveNodes<dim>             &active,
             const std::vector<Expression<dim>> &body_forces,
             const double                        at)
  {
    LinearAlgebra::distributed::Vector<double> forces(active.unknowns());
    const unsigned int                         mass = points.slots().mass;
    on_all_ranks(active.basis().grid().communicator(), [&]() {
      for (unsigned int k = 0; k < active.n_material_cells(); ++k)
        {
          const auto  nodes = active.nodes(k);
          const auto &range = points.ranges()[k];
          for (unsigned int p = range.begin; p < range.end; ++p)
            {
              const Expression<dim> &force = body_forces[points.body(p)];
              if (force.is_zero())
                continue;
              const Tensor<1, dim> load =
                points.data(p)[mass] * force.vector(points.position(p), at);
              for (unsigned int a = 0; a < nodes.size(); ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  forces.local_element(nodes[a] * dim + d) +=
                    points.support(p)[a] * load[d];
            }
        }
    });
    forces.compress(VectorOperation::add);
    return forces;
  }

  template LinearAlgebra::distributed::Vector<double>
  body_force(const MaterialPoints<2> &,
             const ActiveNodes<2> &,
             const std::vector<Expression<2>> &,
             const double);
  template LinearAlgebra::distributed::Vector<double>
  body_force(const MaterialPoints<3> &,
             const ActiveNodes<3> &,
             const std::vector<Expression<3>> &,
             const double);
} // namespace Impoint
