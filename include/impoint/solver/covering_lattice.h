#ifndef impoint_solver_covering_lattice_h
#define impoint_solver_covering_lattice_h

#include <impoint/grid/spline_line.h>
#include <impoint/solver/block_matrix.h>
#include <impoint/solver/node_exchange.h>

#include <deal.II/base/point.h>

#include <vector>

namespace Impoint
{
  /**
   * A Cartesian lattice, about twice as coarse, over nodes of a grid that has
   * none of its own: where multigrid goes first from triangles, tetrahedra or
   * distorted cells. Its linear functions' values at the nodes are the
   * prolongation. It begins where the nodes do, so that it is nested in grids
   * made of split Cartesian cells.
   */
  template <int dim>
  struct CoveringLattice
  {
    /** The nodes of @p pattern stand at @p points [m]. Collective. */
    CoveringLattice(const BlockPattern            &pattern,
                    const NodeExchange            &nodes,
                    const std::vector<Point<dim>> &points);

    std::vector<SplineLine> lines;  // of its functions, one a direction
    std::vector<Point<dim>> places; // of the nodes, in its cells
  };
} // namespace Impoint

#endif
