#include <impoint/solver/gathered_problem.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  GatheredProblem<dim>::GatheredProblem(const MPI_Comm communicator)
    : comm(communicator)
    , on_root(Utilities::MPI::this_mpi_process(comm) == 0)
  {}



  template <int dim>
  void GatheredProblem<dim>::new_pattern(const ActiveNodes<dim>   &nodes,
                                         const LinearProblem<dim> &local)
  {
    active     = &nodes;
    n_unknowns = nodes.unknowns()->size();
    std::vector<unsigned int> own_numbers(nodes.n_nodes());
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
      own_numbers[i] = nodes.global_number(i);
    numbers = Utilities::MPI::gather(comm, own_numbers, 0);
    const auto starts =
      Utilities::MPI::gather(comm, local.pattern.row_start, 0);
    const auto columns = Utilities::MPI::gather(comm, local.pattern.columns, 0);
    if (on_root)
      {
        std::vector<std::vector<unsigned int>> rows(n_unknowns / dim);
        for (unsigned int rank = 0; rank < numbers.size(); ++rank)
          for (unsigned int i = 0; i < numbers[rank].size(); ++i)
            for (std::size_t q = starts[rank][i]; q < starts[rank][i + 1]; ++q)
              rows[numbers[rank][i]].push_back(numbers[rank][columns[rank][q]]);
        gathered.pattern.row_start.assign(1, 0);
        gathered.pattern.columns.clear();
        for (auto &row : rows)
          {
            std::sort(row.begin(), row.end());
            row.erase(std::unique(row.begin(), row.end()), row.end());
            gathered.pattern.columns.insert(gathered.pattern.columns.end(),
                                            row.begin(),
                                            row.end());
            gathered.pattern.row_start.push_back(
              gathered.pattern.columns.size());
          }
        places.assign(numbers.size(), {});
        for (unsigned int rank = 0; rank < numbers.size(); ++rank)
          for (unsigned int i = 0; i < numbers[rank].size(); ++i)
            {
              const unsigned int row   = numbers[rank][i];
              const auto         begin = gathered.pattern.columns.begin() +
                                 gathered.pattern.row_start[row];
              const auto end = gathered.pattern.columns.begin() +
                               gathered.pattern.row_start[row + 1];
              for (std::size_t q = starts[rank][i]; q < starts[rank][i + 1];
                   ++q)
                places[rank].push_back(
                  std::lower_bound(begin,
                                   end,
                                   numbers[rank][columns[rank][q]]) -
                  gathered.pattern.columns.begin());
            }
      }
    gathered.symmetric   = local.symmetric;
    gathered.serves_long = local.serves_long;
    gather_nodes(local);
  }



  /** What the problem says of its nodes; both fit in a row of numbers. */
  template <int dim>
  void GatheredProblem<dim>::gather_nodes(const LinearProblem<dim> &local)
  {
    const unsigned int  n     = active->n_nodes();
    const unsigned int  width = 1 + 2 * dim;
    std::vector<double> nodes(n * width, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        nodes[i * width] = local.enforced[i];
        for (unsigned int d = 0; d < dim; ++d)
          {
            nodes[i * width + 1 + d] = local.points[i][d];
            if (!local.lattice.empty())
              nodes[i * width + 1 + dim + d] = local.lattice[i][d];
          }
      }
    const auto all = Utilities::MPI::gather(comm, nodes, 0);
    if (!on_root)
      return;
    const bool has_lattice   = !local.lines.empty();
    gathered.lines           = local.lines;
    const unsigned int n_all = n_unknowns / dim;
    gathered.enforced.assign(n_all, false);
    gathered.points.assign(n_all, Point<dim>());
    gathered.lattice.assign(has_lattice ? n_all : 0, {});
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (unsigned int i = 0; i < numbers[rank].size(); ++i)
        {
          const double      *node   = all[rank].data() + i * width;
          const unsigned int number = numbers[rank][i];
          if (node[0] != 0)
            gathered.enforced[number] = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              gathered.points[number][d] = node[1 + d];
              if (has_lattice)
                gathered.lattice[number][d] = node[1 + dim + d];
            }
        }
  }



  template <int dim>
  void GatheredProblem<dim>::new_matrix(const LinearProblem<dim> &local)
  {
    gathered.has_moderate = local.has_moderate;
    const auto add_up     = [&](const BlockMatrix<dim> &part,
                            BlockMatrix<dim>       &sum) {
      const auto values = Utilities::MPI::gather(comm, part.values, 0);
      if (!on_root)
        return;
      sum.reinit(gathered.pattern);
      for (unsigned int rank = 0; rank < values.size(); ++rank)
        for (std::size_t q = 0; q < places[rank].size(); ++q)
          for (unsigned int e = 0; e < dim * dim; ++e)
            sum.values[places[rank][q] * dim * dim + e] +=
              values[rank][q * dim * dim + e];
    };
    add_up(local.matrix, gathered.matrix);
    if (local.has_moderate)
      add_up(local.moderate, gathered.moderate);
    gather_nodes(local);
  }



  template <int dim>
  std::vector<double>
  GatheredProblem<dim>::gather(const std::vector<double> &own) const
  {
    std::vector<double> whole;
    for (const auto &part : Utilities::MPI::gather(comm, own, 0))
      whole.insert(whole.end(), part.begin(), part.end());
    return whole;
  }



  template <int dim>
  std::vector<double>
  GatheredProblem<dim>::scatter(const std::vector<double> &whole) const
  {
    const auto all   = Utilities::MPI::broadcast(comm, whole);
    const auto range = active->unknowns()->local_range();
    return {all.begin() + range.first, all.begin() + range.second};
  }

  template class GatheredProblem<2>;
  template class GatheredProblem<3>;
} // namespace Impoint
