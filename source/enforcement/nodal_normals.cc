#include <impoint/enforcement/nodal_normals.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    bool one_normal(const BoundaryParticles<dim> &boundary,
                    const MPI_Comm                communicator)
    {
      Tensor<1, dim> lowest, highest;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lowest[d]  = 2;
          highest[d] = -2;
        }
      for (unsigned int b = 0; b < boundary.n(); ++b)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double n = boundary.vector(b, boundary.slots().normal)[d];
            lowest[d]      = std::min(lowest[d], n);
            highest[d]     = std::max(highest[d], n);
          }
      double largest_difference = 0;
      for (unsigned int d = 0; d < dim; ++d)
        largest_difference =
          std::max(largest_difference,
                   Utilities::MPI::max(highest[d], communicator) -
                     Utilities::MPI::min(lowest[d], communicator));
      return largest_difference < 1e-10;
    }



    template <int dim>
    void NodalNormals<dim>::reinit(const Normals           choice,
                                   const Method<dim>      &method,
                                   const ActiveNodes<dim> &active)
    {
      const auto    &boundary = method.particles();
      const MPI_Comm comm     = active.basis().grid().communicator();
      averaged                = choice == Normals::nodal ||
                 (choice == Normals::automatic && !one_normal(boundary, comm));
      if (!averaged)
        return;

      LinearAlgebra::distributed::Vector<double> sums(active.unknowns());
      for_active_ranges(
        method, active, [&](const unsigned int r, const unsigned int k) {
          const auto &range = boundary.ranges()[r];
          const auto  nodes = active.nodes(k);
          for (unsigned int b = range.begin; b < range.end; ++b)
            for (unsigned int a = 0; a < nodes.size(); ++a)
              for (unsigned int d = 0; d < dim; ++d)
                sums.local_element(nodes[a] * dim + d) +=
                  boundary.vector(b, boundary.slots().normal)[d] *
                  boundary.held_area(b) * boundary.support(b)[a];
        });
      sums.compress(VectorOperation::add);
      sums.update_ghost_values();
      averages.assign(active.n_nodes(), Tensor<1, dim>());
      for (unsigned int i = 0; i < active.n_nodes(); ++i)
        {
          for (unsigned int d = 0; d < dim; ++d)
            averages[i][d] = sums.local_element(i * dim + d);
          if (averages[i].norm() > 0)
            averages[i] /= averages[i].norm();
        }
    }

    template bool one_normal(const BoundaryParticles<2> &, const MPI_Comm);
    template bool one_normal(const BoundaryParticles<3> &, const MPI_Comm);
    template class NodalNormals<2>;
    template class NodalNormals<3>;
  } // namespace Enforcement
} // namespace Impoint
