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
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      way = Way::alone;
    else if (local.symmetric && iterative(active, local))
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
                            !active.basis().lines().empty(),
                            local.serves_long);
  }



  template <int dim>
  void ParallelSolver<dim>::new_matrix(const LinearProblem<dim> &local)
  {
    if (way == Way::together)
      distributed.new_matrix(local);
    else if (way == Way::on_root)
      gathered.new_matrix(local);
    act(local,
        [&](const LinearProblem<dim> &problem) { solver.new_matrix(problem); });
  }



  template <int dim>
  void ParallelSolver<dim>::solve(const LinearProblem<dim> &local,
                                  const Vector             &b,
                                  Vector                   &x,
                                  const double              looser)
  {
    std::vector<double> right(b.begin(), b.end()), solution;
    if (way == Way::on_root)
      right = gathered.gather(right);
    act(local, [&](const LinearProblem<dim> &problem) {
      solver.solve(problem, right, solution, looser);
    });
    if (way == Way::on_root)
      solution = gathered.scatter(solution);
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
