#ifndef impoint_solver_gathered_solver_h
#define impoint_solver_gathered_solver_h

#include <impoint/grid/active_nodes.h>
#include <impoint/solver/linear_solver.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /**
   * Solves linear problems whose matrix is spread over the ranks as each one's
   * sum over its own cells. Alone, a rank hands its problem on as it is; else
   * rank 0 adds up all of them and solves.
   */
  template <int dim>
  class GatheredSolver
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    GatheredSolver(const LinearSolverParameters &parameters,
                   Counters                     &counters,
                   const MPI_Comm                communicator);

    /** All collective; @p local is this rank's part, its rows the active nodes
     * in their compact numbering. */
    void new_pattern(const ActiveNodes<dim>   &active,
                     const LinearProblem<dim> &local);
    bool iterative(const ActiveNodes<dim> &active) const;
    void new_matrix(const LinearProblem<dim> &local);
    void solve(const LinearProblem<dim> &local,
               const Vector             &b,
               Vector                   &x,
               const double              looser = 1.);

    /** Throws RunFailed if a part of the bodies can move as a rigid body at no
     * cost: statics has no answer to that. */
    void check_rigid_modes(const LinearProblem<dim> &local) const;

    std::string description() const;

  private:
    void gather_nodes(const LinearProblem<dim> &local);

    const LinearProblem<dim> &whole(const LinearProblem<dim> &local) const
    {
      return alone ? local : gathered;
    }

    MPI_Comm                comm;
    bool                    alone, on_root;
    LinearSolver<dim>       solver;
    const ActiveNodes<dim> *active     = nullptr;
    std::size_t             n_unknowns = 0;

    // rank 0 of several:
    LinearProblem<dim>                     gathered;
    std::vector<std::vector<unsigned int>> numbers; // per rank: rows' numbers
    std::vector<std::vector<std::size_t>>  places;  // per rank: blocks' places
  };
} // namespace Impoint

#endif
