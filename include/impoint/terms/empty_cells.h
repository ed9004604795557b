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
   * displacements as an elastic cell without stress would (St.
   * Venant-Kirchhoff, nu = 0; or linear): unlike springs to ground this leaves
   * forces and moments in balance, also about the places that nodes have moved
   * to.
   */
  template <int dim>
  class EmptyCells
  {
  public:
    /** @p linear: for small strains, and in dynamics, where a step turns cells
     * little and Newton's method finds its way sooner without their large
     * strains. */
    EmptyCells(const ActiveNodes<dim> &active, const bool linear);

    /** After the set of active cells changed. */
    void reinit();

    /** @p k: an active cell beyond the material cells; @p young: its Young's
     * modulus [Pa], in 2D times the thickness. */
    void
    add(const unsigned int k, const double young, CellSystem &system) const;

    /** Lets the matrix of add(), and only that, resist rigid motions, too. A
     * cell that shares one node with the material turns about it at no cost
     * where its boundary lets go, and without mass the matrix would be
     * singular. */
    void anchor(CellSystem &system) const;

  private:
    /** Of a quadrature point. */
    struct Gradients
    {
      double                      volume;
      std::vector<Tensor<1, dim>> of_nodes;
    };

    std::vector<Gradients> integrate(const unsigned int c) const;

    void add_point(const Gradients &gradients,
                   const double     modulus,
                   CellSystem      &system) const;

    const ActiveNodes<dim>             &active;
    bool                                linear;
    std::vector<std::vector<Gradients>> points; // per empty cell
  };
} // namespace Impoint

#endif
