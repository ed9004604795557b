#include <impoint/particles/smoothed_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <map>

namespace Impoint
{
  namespace
  {
    /** Force and area of a node. */
    template <int dim>
    using NodeSums =
      std::map<types::global_dof_index, std::array<double, dim + 1>>;

    template <int dim>
    void add_up(const NodeSums<dim> &part, NodeSums<dim> &sums)
    {
      for (const auto &node : part)
        {
          auto &sum = sums[node.first]; // 0 at first
          for (unsigned int d = 0; d <= dim; ++d)
            sum[d] += node.second[d];
        }
    }

    /** Calls @p function(b, node, N) for what the particles see. */
    template <int dim, typename Function>
    void for_supports(const BoundaryParticles<dim> &boundary,
                      const Basis<dim>             &basis,
                      const Function               &function)
    {
      for (const auto &range : boundary.ranges())
        {
          const auto nodes = basis.nodes(range.cell);
          for (unsigned int b = range.begin; b < range.end; ++b)
            for (unsigned int a = 0; a < nodes.size(); ++a)
              function(b, basis.global_index(nodes[a]), boundary.support(b)[a]);
        }
    }
  } // namespace



  template <int dim>
  std::vector<Tensor<1, dim>>
  smoothed_forces(const BoundaryParticles<dim> &boundary,
                  const Basis<dim>             &basis)
  {
    using Index = types::global_dof_index;
    std::vector<Tensor<1, dim>> forces;
    for (unsigned int b = 0; b < boundary.n(); ++b)
      forces.push_back(boundary.vector(b, boundary.slots().force));
    if (basis.degree() > 1 && !basis.is_spline())
      return forces;

    NodeSums<dim> own, sums;
    for_supports(boundary,
                 basis,
                 [&](const unsigned int b, const Index node, const double N) {
                   auto &sum = own[node];
                   for (unsigned int d = 0; d < dim; ++d)
                     sum[d] += N * forces[b][d];
                   sum[dim] += N * boundary.area(b);
                 });
    for (const auto &part :
         Utilities::MPI::all_gather(basis.grid().communicator(), own))
      add_up<dim>(part, sums);
    std::fill(forces.begin(), forces.end(), Tensor<1, dim>());
    for_supports(boundary,
                 basis,
                 [&](const unsigned int b, const Index node, const double N) {
                   const auto &sum = sums.at(node);
                   for (unsigned int d = 0; d < dim && N != 0; ++d)
                     forces[b][d] += N * boundary.area(b) / sum[dim] * sum[d];
                 });
    return forces;
  }

  template std::vector<Tensor<1, 2>>
  smoothed_forces(const BoundaryParticles<2> &, const Basis<2> &);
  template std::vector<Tensor<1, 3>>
  smoothed_forces(const BoundaryParticles<3> &, const Basis<3> &);
} // namespace Impoint
