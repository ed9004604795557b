#ifndef impoint_solver_gathered_problem_h
#define impoint_solver_gathered_problem_h

#include <impoint/grid/active_nodes.h>
#include <impoint/solver/linear_solver.h>

namespace Impoint
{
  /**
   * The linear problem whose matrix is spread over several ranks as each one's
   * sum over its own cells, added up on rank 0. All collective.
   */
  template <int dim>
  class GatheredProblem
  {
  public:
    explicit GatheredProblem(const MPI_Comm communicator);

    /** @p local is this rank's part, its rows the active nodes in their compact
     * numbering. */
    void new_pattern(const ActiveNodes<dim>   &active,
                     const LinearProblem<dim> &local);
    void new_matrix(const LinearProblem<dim> &local);

    /** On rank 0 alone. */
    const LinearProblem<dim> &problem() const
    {
      return gathered;
    }

    /** Values of the unknowns owned, to rank 0; and of all on rank 0, to their
     * owners. */
    std::vector<double> gather(const std::vector<double> &own) const;
    std::vector<double> scatter(const std::vector<double> &whole) const;

  private:
    void gather_nodes(const LinearProblem<dim> &local);

    MPI_Comm                comm;
    bool                    on_root;
    const ActiveNodes<dim> *active     = nullptr;
    std::size_t             n_unknowns = 0;

    // rank 0:
    LinearProblem<dim>                     gathered;
    std::vector<std::vector<unsigned int>> numbers; // per rank: rows' numbers
    std::vector<std::vector<std::size_t>>  places;  // per rank: blocks' places
  };
} // namespace Impoint

#endif
