#ifndef impoint_grid_basis_h
#define impoint_grid_basis_h

#include <impoint/grid/background_grid.h>

#include <deal.II/base/array_view.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * The functions that carry the displacement: which nodes (unknowns) a place
   * sees, with values and gradients. Nothing else in the code knows how many
   * nodes a cell has or where they are.
   *
   * Nodes are numbered 0 ... n_nodes() - 1 on this rank (ghosts included).
   * Hanging nodes never appear: their values are written in terms of the nodes
   * they depend on, which only lengthens the list of a cell next to them.
   */
  template <int dim>
  class Basis
  {
  public:
    /** Linear functions on the cells of @p grid, which outlives the basis. */
    explicit Basis(const BackgroundGrid<dim> &grid);
    ~Basis();

    const BackgroundGrid<dim> &grid() const
    {
      return background;
    }

    unsigned int n_nodes() const
    {
      return points.size();
    }

    /** Nodes of all functions that do not vanish in cell @p c. */
    ArrayView<const unsigned int> nodes(const unsigned int c) const
    {
      return ArrayView<const unsigned int>(cell_nodes.data() + first_node[c],
                                           first_node[c + 1] - first_node[c]);
    }

    unsigned int n_nodes_of(const unsigned int c) const
    {
      return first_node[c + 1] - first_node[c];
    }

    /** Number of doubles of a support in cell @p c: a value and dim
     * derivatives per node. */
    unsigned int support_size(const unsigned int c) const
    {
      return (dim + 1) * n_nodes_of(c);
    }

    /**
     * Support of the place @p xi (reference coordinates) in cell @p c: values
     * N_a, then gradients dN_a/dx_d at [n + a * dim + d].
     */
    void
    evaluate(const unsigned int c, const Point<dim> &xi, double *support) const;

    /** The same through FEValues: any cell, an oracle in tests. */
    void evaluate_by_fe_values(const unsigned int c,
                               const Point<dim>  &xi,
                               double            *support) const;

    types::global_dof_index global_index(const unsigned int node) const
    {
      return global_indices[node];
    }

    /** The rank that numbers the node. */
    unsigned int owner(const unsigned int node) const
    {
      return owners[node];
    }

    const Point<dim> &point(const unsigned int node) const
    {
      return points[node];
    }

    /** Node of this rank with a global index, BackgroundGrid::nowhere if it
     * has none. */
    unsigned int node_of(const types::global_dof_index index) const;

    /** Nodes on the part of the grid's boundary with @p boundary_id, with the
     * area-weighted sum of the outward face normals at each. */
    std::vector<std::pair<unsigned int, Tensor<1, dim>>>
    boundary_nodes(const types::boundary_id boundary_id) const;

    std::string name() const
    {
      return "linear";
    }

  private:
    struct Elements; // DoFHandler and what goes with it

    void number_nodes();
    void list_cell_nodes();

    const BackgroundGrid<dim>           &background;
    std::unique_ptr<Elements>            elements;
    std::vector<types::global_dof_index> global_indices; // increasing
    std::vector<unsigned int>            owners;
    std::vector<Point<dim>>              points;
    std::vector<std::size_t>             first_node; // per cell
    std::vector<unsigned int>            cell_nodes;

    // Cells with hanging nodes: position in hanging, or nowhere. Row-major
    // vertices x nodes: the weight of each node in each vertex' function.
    std::vector<unsigned int>        hanging_index;
    std::vector<std::vector<double>> hanging;
  };
} // namespace Impoint

#endif
