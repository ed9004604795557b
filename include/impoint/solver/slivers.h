#ifndef impoint_solver_slivers_h
#define impoint_solver_slivers_h

#include <impoint/solver/block_matrix.h>
#include <impoint/solver/node_exchange.h>

#include <vector>

namespace Impoint
{
  /** Which nodes, ghosts included, have a diagonal below @p part of the median
   * of all. Collective. */
  template <int dim>
  std::vector<char> find_slivers(const BlockMatrix<dim> &matrix,
                                 const NodeExchange     &nodes,
                                 const double            part);
} // namespace Impoint

#endif
