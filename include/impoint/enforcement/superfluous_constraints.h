#ifndef impoint_enforcement_superfluous_constraints_h
#define impoint_enforcement_superfluous_constraints_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/boundary_particles.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Which of a boundary's constraints, one a cell, the others make
     * superfluous: per range of this rank's @p boundary (L Section 3.2.2).
     *
     * A constrained neighbour determines one edge that it shares with a cell.
     * The cell needs no constraint of its own where such edges, each by a
     * neighbour of its own that keeps its constraint, connect all its nodes:
     * two edges of a triangle, three of a quadrilateral or tetrahedron, seven
     * of a hexahedron. The first cell of each piece of the boundary and its
     * next neighbour keep theirs. Cells come in the order of their particles,
     * so the choice does not depend on the number of ranks. Collective.
     */
    template <int dim>
    std::vector<char>
    superfluous_constraints(const BoundaryParticles<dim> &boundary,
                            const ActiveNodes<dim>       &active);
  } // namespace Enforcement
} // namespace Impoint

#endif
