#ifndef impoint_grid_splines_h
#define impoint_grid_splines_h

#include <impoint/grid/cell_functions.h>
#include <impoint/grid/spline_line.h>

namespace Impoint
{
  /**
   * Tensor products of B-splines on a grid that is a lattice. A function has
   * the global index of its place in the box of all cells, whatever the ranks;
   * it is owned by the lowest rank that owns a cell of its support.
   */
  template <int dim>
  class Splines : public CellFunctions<dim>
  {
  public:
    Splines(const BackgroundGrid<dim> &grid, const unsigned int degree);

    void evaluate(const unsigned int c,
                  const Point<dim>  &xi,
                  double            *support) const override;

    /** The functions of the cell's outermost layer. */
    std::vector<unsigned int>
    nodes_on_face(const unsigned int c, const unsigned int f) const override;

    /** Only the sides of the box of all cells have knots of their own. */
    bool can_hold_face(const unsigned int c,
                       const unsigned int f) const override;

  private:
    void list_cell_nodes();
    void place_nodes();
    void find_owners();

    types::global_dof_index index(const std::array<int, dim> &place) const;

    const unsigned int                degree;
    std::vector<SplineLine>           lines; // one a direction
    std::vector<std::array<int, dim>> cell_places;
  };
} // namespace Impoint

#endif
