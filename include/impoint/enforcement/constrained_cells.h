#ifndef impoint_enforcement_constrained_cells_h
#define impoint_enforcement_constrained_cells_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/boundary_particles.h>

#include <deal.II/grid/cell_id.h>

#include <array>
#include <functional>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /** Of the angle between the normals of cells that hold one wall: at least.
     */
    constexpr double one_wall_cosine = 0.9;

    /**
     * All ranks' active cells with particles of a boundary, one constraint
     * each, in the order of their first particles' ids: what is chosen among
     * them does not depend on the number of ranks. Without cells whose unknowns
     * are not their vertices (hanging nodes, smooth or higher functions).
     */
    template <int dim>
    class ConstrainedCells
    {
    public:
      static constexpr auto no_vertex = numbers::invalid_dof_index;

      /** All that ranks tell each other. */
      struct Cell
      {
        types::particle_index                  id; // of its first particle
        std::array<types::global_dof_index, 8> vertices;
        unsigned int                           n_vertices;
        CellId::binary_type                    cell;
        unsigned int                           rank; // its owner
        double                                 size; // h
        double area; // of the particles, in 2D times the thickness
        std::array<double, dim> centre, normal; // means of the particles

        template <class Archive>
        void serialize(Archive &archive, const unsigned int)
        {
          archive &id &vertices &n_vertices &cell &rank &size &area &centre
            &normal;
        }
      };

      /** Two vertices of a cell, as numbers of its own. */
      using Edge = std::pair<unsigned int, unsigned int>;

      using Choice = std::function<bool(const unsigned int r)>;

      /** Of the ranges that @p wanted wants, or of all. Collective. */
      ConstrainedCells(const BoundaryParticles<dim> &boundary,
                       const ActiveNodes<dim>       &active,
                       const Choice                 &wanted = nullptr);

      /** Whether the unknowns of grid cell @p cell are its vertices. */
      static bool nodes_are_vertices(const Basis<dim>  &basis,
                                     const unsigned int cell);

      const std::vector<Cell> &cells() const
      {
        return all;
      }

      /** Number of the cell of this rank's range @p r, or nowhere. */
      unsigned int of_range(const unsigned int r) const
      {
        return numbers_of_ranges[r];
      }

      bool share_vertex(const unsigned int i, const unsigned int j) const;

      /** Edges of cell @p i that cell @p j has, too. */
      std::vector<Edge> shared_edges(const unsigned int i,
                                     const unsigned int j) const;

      /** For each cell those with which it shares an edge, increasing. */
      std::vector<std::vector<unsigned int>> edge_neighbors() const;

      /** For each cell the first one of those that @p neighbors connect with
       * it. */
      static std::vector<unsigned int>
      pieces(const std::vector<std::vector<unsigned int>> &neighbors);

    private:
      static Cell describe(const BoundaryParticles<dim> &boundary,
                           const unsigned int            r,
                           const Basis<dim>             &basis);

      bool                      simplicial;
      std::vector<Cell>         all;
      std::vector<unsigned int> numbers_of_ranges;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
