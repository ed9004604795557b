#ifndef impoint_grid_basis_h
#define impoint_grid_basis_h

#include <impoint/grid/cell_functions.h>
#include <impoint/grid/spline_line.h>

#include <deal.II/base/array_view.h>

#include <memory>
#include <string>
#include <vector>

namespace Impoint
{
  /**
   * The functions that carry the displacement: which nodes (unknowns) a place
   * sees, with values and gradients. Nothing else in the code knows how many
   * nodes a cell has or where they are.
   *
   * Nodes are numbered 0 ... n_nodes() - 1 on this rank (ghosts included).
   */
  template <int dim>
  class Basis
  {
  public:
    /** Linear functions on the cells of @p grid, which outlives the basis. */
    explicit Basis(const BackgroundGrid<dim> &grid);

    /** The functions that @p parameters ask for. Throws InputError if there are
     * none on this grid. */
    Basis(const BackgroundGrid<dim> &grid,
          const ParameterFile       &file,
          const GridParameters      &parameters);

    const BackgroundGrid<dim> &grid() const
    {
      return background;
    }

    unsigned int n_nodes() const
    {
      return lists().points.size();
    }

    /** Nodes of all functions that do not vanish in cell @p c. */
    ArrayView<const unsigned int> nodes(const unsigned int c) const
    {
      return ArrayView<const unsigned int>(lists().cell_nodes.data() +
                                             lists().first_node[c],
                                           n_nodes_of(c));
    }

    unsigned int n_nodes_of(const unsigned int c) const
    {
      return lists().n_nodes_of(c);
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
    evaluate(const unsigned int c, const Point<dim> &xi, double *support) const
    {
      functions->evaluate(c, xi, support);
    }

    /** The same for several places @p xi in the cell, one support after the
     * other. */
    void evaluate(const unsigned int                 c,
                  const ArrayView<const Point<dim>> &xi,
                  double                            *supports) const
    {
      functions->evaluate_all(c, xi, supports);
    }

    types::global_dof_index global_index(const unsigned int node) const
    {
      return lists().global_indices[node];
    }

    /** The rank that numbers the node. */
    unsigned int owner(const unsigned int node) const
    {
      return lists().owners[node];
    }

    /** Where the node is: its coefficient of a linear field is the field's
     * value there. Splines have other values at these places than coefficients.
     */
    const Point<dim> &point(const unsigned int node) const
    {
      return lists().points[node];
    }

    /** Node of this rank with a global index, BackgroundGrid::nowhere if it
     * has none. */
    unsigned int node_of(const types::global_dof_index index) const
    {
      return lists().node_of(index);
    }

    /** Nodes that hold the part of the grid's boundary with @p boundary_id:
     * their functions alone do not vanish there. With the area-weighted sum of
     * the outward face normals at each. Collective. */
    std::vector<std::pair<unsigned int, Tensor<1, dim>>>
    boundary_nodes(const types::boundary_id boundary_id) const;

    /** Whether there are such nodes for all of that part. Collective. */
    bool can_hold(const types::boundary_id boundary_id) const;

    /** Lines of functions, one a direction, whose products the nodes are:
     * geometric multigrid coarsens them. Empty where there are none. */
    const std::vector<SplineLine> &lines() const
    {
      return lattice_lines;
    }

    /** Place of a node on those lines. */
    const std::array<int, dim> &lattice_place(const unsigned int node) const
    {
      return lists().lattice[node];
    }

    /** Whether functions reach over more than one cell, so that what a cell's
     * points do not see others may. */
    bool is_spline() const
    {
      return kind.find("spline") != std::string::npos;
    }

    /** Whether no function is negative anywhere: then a node's sum of N_I
     * times masses is a mass. */
    bool is_positive() const
    {
      return kind != "quadratic";
    }

    /** Highest power of one coordinate. */
    unsigned int degree() const
    {
      return of_degree;
    }

    /** As in the parameter file. */
    const std::string &name() const
    {
      return kind;
    }

  private:
    using NodalNormals = std::vector<std::array<double, dim + 1>>;

    const NodeLists<dim> &lists() const
    {
      return functions->lists();
    }

    void make_functions();
    void sum_over_ranks(NodalNormals &normals) const;

    const BackgroundGrid<dim>          &background;
    std::string                         kind;
    unsigned int                        of_degree;
    std::unique_ptr<CellFunctions<dim>> functions;
    std::vector<SplineLine>             lattice_lines;
  };
} // namespace Impoint

#endif
