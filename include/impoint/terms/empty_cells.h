#ifndef impoint_terms_empty_cells_h
#define impoint_terms_empty_cells_h

#include <impoint/grid/active_nodes.h>
#include <impoint/terms/term.h>

#include <vector>

namespace Impoint
{
  /**
   * Stiffness of active cells that hold boundary particles but no material
   * (L section 3.6). Their far nodes would take up a gap at no cost, and the
   * boundary would hold nothing. Here the cell resists the step's
   * displacements as an elastic cell without stress would: unlike springs to
   * ground this leaves forces and moments in balance.
   */
  template <int dim>
  class EmptyCells
  {
  public:
    /** @p young: Young's modulus of the stiffest material [Pa]. */
    EmptyCells(const ActiveNodes<dim> &active, const double young);

    /** After the set of active cells changed. */
    void reinit();

    /**
     * @p k: an active cell beyond the material cells. One that @p moves_freely,
     * as in dynamics where a contact may be open, can turn about a node that
     * it shares with the material: a ridge, in the matrix only, makes that
     * definite.
     */
    void add(const unsigned int k,
             const bool         moves_freely,
             CellSystem        &system) const;

  private:
    void integrate(const unsigned int c, std::vector<double> &matrix) const;

    const ActiveNodes<dim>          &active;
    double                           young;
    std::vector<std::vector<double>> matrices; // per empty cell
  };
} // namespace Impoint

#endif
