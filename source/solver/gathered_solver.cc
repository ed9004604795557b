#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/gathered_solver.h>
#include <impoint/solver/rigid_modes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  GatheredSolver<dim>::GatheredSolver(const LinearSolverParameters &parameters,
                                      Counters                     &counters,
                                      const MPI_Comm communicator)
    : comm(communicator)
    , alone(Utilities::MPI::n_mpi_processes(comm) == 1)
    , on_root(Utilities::MPI::this_mpi_process(comm) == 0)
    , solver(parameters, counters)
  {}



  template <int dim>
  void GatheredSolver<dim>::new_pattern(const ActiveNodes<dim>   &nodes,
                                        const LinearProblem<dim> &local)
  {
    active     = &nodes;
    n_unknowns = nodes.unknowns()->size();
    if (alone)
      return solver.new_pattern(local);

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
    gathered.symmetric = local.symmetric;
    gather_nodes(local);
    Impoint::on_root(comm, [&]() { solver.new_pattern(gathered); });
  }



  /** What the problem says of its nodes; both fit in a row of numbers. */
  template <int dim>
  void GatheredSolver<dim>::gather_nodes(const LinearProblem<dim> &local)
  {
    const unsigned int  n     = active->n_nodes();
    const unsigned int  width = 2 + 2 * dim;
    std::vector<double> nodes(n * width, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        nodes[i * width]     = local.regularisation[i];
        nodes[i * width + 1] = local.enforced[i];
        for (unsigned int d = 0; d < dim; ++d)
          {
            nodes[i * width + 2 + d] = local.points[i][d];
            if (!local.lattice.empty())
              nodes[i * width + 2 + dim + d] = local.lattice[i][d];
          }
      }
    const auto all = Utilities::MPI::gather(comm, nodes, 0);
    if (!on_root)
      return;
    const bool has_lattice   = !local.lines.empty();
    gathered.lines           = local.lines;
    const unsigned int n_all = n_unknowns / dim;
    gathered.regularisation.assign(n_all, 0.);
    gathered.enforced.assign(n_all, false);
    gathered.points.assign(n_all, Point<dim>());
    gathered.lattice.assign(has_lattice ? n_all : 0, {});
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (unsigned int i = 0; i < numbers[rank].size(); ++i)
        {
          const double      *node   = all[rank].data() + i * width;
          const unsigned int number = numbers[rank][i];
          gathered.regularisation[number] =
            std::max(gathered.regularisation[number], node[0]);
          if (node[1] != 0)
            gathered.enforced[number] = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              gathered.points[number][d] = node[2 + d];
              if (has_lattice)
                gathered.lattice[number][d] = node[2 + dim + d];
            }
        }
  }



  template <int dim>
  bool GatheredSolver<dim>::iterative(const ActiveNodes<dim> &nodes) const
  {
    return solver.iterative(nodes.unknowns()->size(),
                            !nodes.basis().lines().empty());
  }



  template <int dim>
  void GatheredSolver<dim>::new_matrix(const LinearProblem<dim> &local)
  {
    if (alone)
      return solver.new_matrix(local);

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
    Impoint::on_root(comm, [&]() { solver.new_matrix(gathered); });
  }



  template <int dim>
  void GatheredSolver<dim>::solve(const LinearProblem<dim> &local,
                                  const Vector             &b,
                                  Vector                   &x,
                                  const double              looser)
  {
    const unsigned int  n_own = active->n_owned_nodes() * dim;
    std::vector<double> own(b.begin(), b.begin() + n_own), solution;
    if (alone)
      {
        solver.solve(local, own, solution, looser);
        std::copy(solution.begin(), solution.end(), x.begin());
        return;
      }
    const auto          parts = Utilities::MPI::gather(comm, own, 0);
    std::vector<double> whole_b;
    for (const auto &part : parts)
      whole_b.insert(whole_b.end(), part.begin(), part.end());
    Impoint::on_root(comm, [&]() {
      solver.solve(gathered, whole_b, solution, looser);
    });
    solution                = Utilities::MPI::broadcast(comm, solution);
    const std::size_t first = x.get_partitioner()->local_range().first;
    std::copy(solution.begin() + first,
              solution.begin() + first + n_own,
              x.begin());
  }



  template <int dim>
  void
  GatheredSolver<dim>::check_rigid_modes(const LinearProblem<dim> &local) const
  {
    Impoint::on_root(comm, [&]() { Impoint::check_rigid_modes(whole(local)); });
  }



  template <int dim>
  std::string GatheredSolver<dim>::description() const
  {
    return Utilities::MPI::broadcast(comm, solver.description());
  }

  template class GatheredSolver<2>;
  template class GatheredSolver<3>;
} // namespace Impoint
