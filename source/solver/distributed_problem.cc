#include <impoint/solver/distributed_problem.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  void DistributedProblem<dim>::new_pattern(const LinearProblem<dim> &local,
                                            const NodeExchange       &nodes)
  {
    part_nodes = nodes;
    rows.new_pattern(local.pattern, nodes);
    distributed.nodes     = rows.nodes();
    distributed.pattern   = rows.pattern();
    distributed.symmetric = local.symmetric;
    distributed.lines     = local.lines;

    const unsigned int  n_owned     = distributed.pattern.n_rows();
    const unsigned int  n           = n_owned + distributed.nodes.n_ghosts();
    const bool          has_lattice = !local.lines.empty();
    std::vector<double> places(2 * dim * std::size_t(n));
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          places[2 * dim * i + d] = local.points[i][d];
          if (has_lattice)
            places[2 * dim * i + dim + d] = local.lattice[i][d];
        }
    distributed.nodes.update(places);
    distributed.points.resize(n);
    distributed.lattice.resize(has_lattice ? n : 0);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          distributed.points[i][d] = places[2 * dim * i + d];
          if (has_lattice)
            distributed.lattice[i][d] =
              static_cast<int>(places[2 * dim * i + dim + d]);
        }
    share_nodes(local);
  }



  /** What only ranks with cells at a node know of it. */
  template <int dim>
  void DistributedProblem<dim>::share_nodes(const LinearProblem<dim> &local)
  {
    const std::size_t n =
      distributed.pattern.n_rows() + distributed.nodes.n_ghosts();
    const auto share = [&](std::vector<double> values) {
      part_nodes.keep_largest(values);
      values.resize(n);
      distributed.nodes.update(values);
      return values;
    };
    const auto enforced = share({local.enforced.begin(), local.enforced.end()});
    distributed.enforced.assign(enforced.begin(), enforced.end());
  }



  template <int dim>
  void DistributedProblem<dim>::new_matrix(const LinearProblem<dim> &local)
  {
    rows.add_up(local.matrix, distributed.matrix);
    distributed.has_moderate = local.has_moderate;
    if (local.has_moderate)
      rows.add_up(local.moderate, distributed.moderate);
    share_nodes(local);
  }

  template class DistributedProblem<2>;
  template class DistributedProblem<3>;
} // namespace Impoint
