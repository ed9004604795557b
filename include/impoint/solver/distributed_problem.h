#ifndef impoint_solver_distributed_problem_h
#define impoint_solver_distributed_problem_h

#include <impoint/solver/linear_solver.h>
#include <impoint/solver/owned_rows.h>

namespace Impoint
{
  /**
   * The linear problem whose matrix is spread over several ranks as each one's
   * sum over its own cells, with whole rows on the ranks that own them. All
   * collective.
   */
  template <int dim>
  class DistributedProblem
  {
  public:
    /** @p local is this rank's part, its rows are those of @p nodes. */
    void new_pattern(const LinearProblem<dim> &local,
                     const NodeExchange       &nodes);
    void new_matrix(const LinearProblem<dim> &local);

    const LinearProblem<dim> &problem() const
    {
      return distributed;
    }

  private:
    void share_nodes(const LinearProblem<dim> &local);

    NodeExchange       part_nodes;
    OwnedRows<dim>     rows;
    LinearProblem<dim> distributed;
  };
} // namespace Impoint

#endif
