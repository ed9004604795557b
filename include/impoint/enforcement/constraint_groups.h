#ifndef impoint_enforcement_constraint_groups_h
#define impoint_enforcement_constraint_groups_h

#include <impoint/enforcement/constrained_cells.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Which of a boundary's cells share a constraint: numbers of @p cells, a
     * list for each group, increasing.
     *
     * Multipliers are stable where each has about as much of the boundary as a
     * trace has degrees of freedom: as cells that a boundary cuts at random
     * have not. So the group with the least area joins the nearest of those
     * next to it until all have 0.4 h^(dim-1), in simplices, of which a
     * boundary cuts about twice as many, 1. (With 0.8, where a boundary follows
     * a line of vertices, groups as long as the edges between them were free to
     * alternate.) The groups of a flat boundary can carry any even traction, so
     * that patch tests hold, other than without what is superfluous (L Section
     * 3.2.2).
     *
     * No group reaches farther than the cells around one of its own, so that a
     * rank knows them all; none goes around a corner; and no connected piece of
     * the boundary is left with fewer than dim, which hold its rotations.
     */
    template <int dim>
    class ConstraintGroups
    {
    public:
      ConstraintGroups(const ConstrainedCells<dim> &cells,
                       const bool                   simplicial,
                       const double                 thickness);

      const std::vector<std::vector<unsigned int>> &groups() const
      {
        return members;
      }

      /** The first cell of a group that shares a vertex with all of it. */
      unsigned int hub(const std::vector<unsigned int> &group) const;

    private:
      /** What a group that begins with a cell has come to. */
      struct Sum
      {
        std::vector<unsigned int> cells;
        double                    area;
        Tensor<1, dim>            centre, normal; // times the area
      };

      void join_neighbors(const double smallest);
      void join(const unsigned int a, const unsigned int b);
      bool may_join(const unsigned int a, const unsigned int b) const;
      unsigned int
      nearest(const unsigned int                            a,
              const std::vector<std::vector<unsigned int>> &neighbors) const;

      const ConstrainedCells<dim>           &constrained;
      const double                           thickness;
      std::vector<Sum>                       sums; // empty: has joined another
      std::vector<unsigned int>              group_of;
      std::vector<std::vector<unsigned int>> members;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
