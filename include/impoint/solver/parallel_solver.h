#ifndef impoint_solver_parallel_solver_h
#define impoint_solver_parallel_solver_h

#include <impoint/solver/distributed_problem.h>
#include <impoint/solver/gathered_problem.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /**
   * Solves linear problems whose matrix is spread over the ranks as each one's
   * sum over its own cells. Alone, a rank hands its problem on as it is. Of
   * several, all iterate together on large problems, and on those that are not
   * symmetric, while small ones, and those that must be factorised, are
   * gathered on rank 0.
   */
  template <int dim>
  class ParallelSolver
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    ParallelSolver(const LinearSolverParameters &parameters,
                   Counters                     &counters,
                   const MPI_Comm                communicator);

    /** All collective; @p local is this rank's part, its rows the active nodes
     * in their compact numbering. */
    void new_pattern(const ActiveNodes<dim>   &active,
                     const LinearProblem<dim> &local);
    bool iterative(const ActiveNodes<dim>   &active,
                   const LinearProblem<dim> &local) const;
    void new_matrix(const LinearProblem<dim> &local);
    void solve(const LinearProblem<dim> &local,
               const Vector             &b,
               Vector                   &x,
               const double              looser  = 1.,
               const double              further = 0.);

    /** Throws RunFailed if a part of the bodies can move as a rigid body at no
     * cost: statics has no answer to that. */
    void check_rigid_modes(const LinearProblem<dim> &local) const;

    std::string description() const;

  private:
    enum class Way
    {
      alone,
      together,
      on_root
    };

    /** Lets those ranks act on the problem that have it. */
    template <typename Action>
    void act(const LinearProblem<dim> &local, const Action &action) const;

    void solve_on_root(std::vector<double> &right,
                       std::vector<double> &solution,
                       const double         looser);

    /** Together if that serves, else on rank 0. */
    void solve_unsymmetric(const LinearProblem<dim> &local,
                           std::vector<double>      &right,
                           std::vector<double>      &solution,
                           const double              looser);

    MPI_Comm                comm;
    bool                    direct; // that kind
    const ActiveNodes<dim> *nodes = nullptr;

    // what of a problem that all have together rank 0 has as well
    bool                    has_pattern = false, has_matrix = false;
    Way                     way = Way::alone;
    LinearSolver<dim>       solver;
    GatheredProblem<dim>    gathered;
    DistributedProblem<dim> distributed;
  };
} // namespace Impoint

#endif
