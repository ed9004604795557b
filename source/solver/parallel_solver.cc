#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/parallel_solver.h>
#include <impoint/solver/rigid_modes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  ParallelSolver<dim>::ParallelSolver(const LinearSolverParameters &parameters,
                                      Counters                     &counters,
                                      const MPI_Comm communicator)
    : comm(communicator)
    , direct(parameters.kind == "direct")
    , solver(parameters, counters)
    , gathered(communicator)
  {}



  template <int dim>
  template <typename Action>
  void ParallelSolver<dim>::act(const LinearProblem<dim> &local,
                                const Action             &action) const
  {
    if (way == Way::alone)
      action(local);
    else if (way == Way::together)
      action(distributed.problem());
    else
      Impoint::on_root(comm, [&]() { action(gathered.problem()); });
  }



  template <int dim>
  void ParallelSolver<dim>::new_pattern(const ActiveNodes<dim>   &active,
                                        const LinearProblem<dim> &local)
  {
    nodes       = &active;
    has_pattern = has_matrix = false;
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      way = Way::alone;
    else if (local.symmetric ? iterative(active, local) : !direct)
      {
        way = Way::together;
        std::vector<NodeExchange::Number> ghosts;
        for (unsigned int i = active.n_owned_nodes(); i < active.n_nodes(); ++i)
          ghosts.push_back(active.global_number(i));
        distributed.new_pattern(
          local, NodeExchange(comm, active.n_owned_nodes(), ghosts));
      }
    else
      {
        way = Way::on_root;
        gathered.new_pattern(active, local);
      }
    act(local, [&](const LinearProblem<dim> &problem) {
      solver.new_pattern(problem);
    });
  }



  template <int dim>
  bool ParallelSolver<dim>::iterative(const ActiveNodes<dim>   &active,
                                      const LinearProblem<dim> &local) const
  {
    return solver.iterative(active.unknowns()->size(),
                            active.basis().lines(),
                            local.serves_long);
  }



  template <int dim>
  void ParallelSolver<dim>::new_matrix(const LinearProblem<dim> &local)
  {
    has_matrix = false;
    if (way == Way::together)
      distributed.new_matrix(local);
    else if (way == Way::on_root)
      gathered.new_matrix(local);
    act(local,
        [&](const LinearProblem<dim> &problem) { solver.new_matrix(problem); });
  }



  template <int dim>
  void ParallelSolver<dim>::solve_on_root(std::vector<double> &right,
                                          std::vector<double> &solution,
                                          const double         looser)
  {
    right = gathered.gather(right);
    Impoint::on_root(comm, [&]() {
      if (way == Way::on_root)
        solver.solve(gathered.problem(), right, solution, looser);
      else
        solver.solve_by_pivots(gathered.problem(), right, solution);
    });
    solution = gathered.scatter(solution);
  }



  template <int dim>
  void ParallelSolver<dim>::solve_unsymmetric(const LinearProblem<dim> &local,
                                              std::vector<double>      &right,
                                              std::vector<double> &solution,
                                              const double         looser)
  {
    if (!has_matrix && solver.solve_incompletely(
                         distributed.problem(), right, solution, looser))
      return;
    if (!has_pattern)
      gathered.new_pattern(*nodes, local);
    if (!has_matrix)
      gathered.new_matrix(local);
    has_pattern = has_matrix = true;
    solve_on_root(right, solution, looser);
  }



  template <int dim>
  void ParallelSolver<dim>::solve(const LinearProblem<dim> &local,
                                  const Vector             &b,
                                  Vector                   &x,
                                  const double              looser,
                                  const double              further)
  {
    std::vector<double> right(b.begin(), b.end()), solution;
    if (way == Way::on_root)
      solve_on_root(right, solution, looser);
    else if (way == Way::together && !local.symmetric)
      solve_unsymmetric(local, right, solution, looser);
    else
      act(local, [&](const LinearProblem<dim> &problem) {
        solver.solve(problem, right, solution, looser, further);
      });
    std::copy(solution.begin(), solution.end(), x.begin());
  }



  template <int dim>
  void
  ParallelSolver<dim>::check_rigid_modes(const LinearProblem<dim> &local) const
  {
    act(local, [](const LinearProblem<dim> &problem) {
      Impoint::check_rigid_modes(problem);
    });
  }



  template <int dim>
  std::string ParallelSolver<dim>::description() const
  {
    return Utilities::MPI::broadcast(comm, solver.description());
  }

  template class ParallelSolver<2>;
  template class ParallelSolver<3>;
} // namespace Impoint
