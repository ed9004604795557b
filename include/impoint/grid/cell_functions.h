#ifndef impoint_grid_cell_functions_h
#define impoint_grid_cell_functions_h

#include <impoint/grid/background_grid.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/types.h>

#include <array>
#include <vector>

namespace Impoint
{
  /** The nodes (unknowns) that a rank knows, and those of each cell. */
  template <int dim>
  struct NodeLists
  {
    std::vector<types::global_dof_index> global_indices; // increasing
    std::vector<unsigned int>            owners;
    std::vector<Point<dim>>              points;
    std::vector<std::array<int, dim>>    lattice; // empty: the nodes have none
    std::vector<std::size_t>             first_node; // per cell
    std::vector<unsigned int>            cell_nodes;

    unsigned int n_nodes_of(const unsigned int c) const
    {
      return first_node[c + 1] - first_node[c];
    }

    /** BackgroundGrid::nowhere if the rank does not know the index. */
    unsigned int node_of(const types::global_dof_index index) const;
  };

  /**
   * One kind of functions on the cells of a grid, for Basis, which is all that
   * the rest of the code sees of them.
   */
  template <int dim>
  class CellFunctions
  {
  public:
    /** The grid outlives the functions. */
    explicit CellFunctions(const BackgroundGrid<dim> &grid)
      : grid(grid)
    {}
    virtual ~CellFunctions() = default;

    const NodeLists<dim> &lists() const
    {
      return node_lists;
    }

    /** See Basis::evaluate(). */
    virtual void evaluate(const unsigned int c,
                          const Point<dim>  &xi,
                          double            *support) const = 0;

    /** The same for several places @p xi, one support after the other. */
    virtual void evaluate_all(const unsigned int                 c,
                              const ArrayView<const Point<dim>> &xi,
                              double                            *supports) const
    {
      for (const Point<dim> &place : xi)
        {
          evaluate(c, place, supports);
          supports += (dim + 1) * node_lists.n_nodes_of(c);
        }
    }

    /**
     * Nodes of the known cell @p c whose functions do not vanish on its face
     * @p f, which lies on the grid's boundary. Holding them holds the face: all
     * other functions of the cell must vanish there.
     */
    virtual std::vector<unsigned int>
    nodes_on_face(const unsigned int c, const unsigned int f) const = 0;

    /** Whether nodes_on_face() has an answer. */
    virtual bool can_hold_face(const unsigned int c,
                               const unsigned int f) const = 0;

  protected:
    const BackgroundGrid<dim> &grid;
    NodeLists<dim>             node_lists;
  };
} // namespace Impoint

#endif
