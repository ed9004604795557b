#ifndef impoint_terms_hourglass_h
#define impoint_terms_hourglass_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>
#include <impoint/terms/term.h>

#include <vector>

namespace Impoint
{
  /**
   * Stiffness against the modes that a cell's points cannot see if they are too
   * few. One point in a quadrilateral is a pendulum: it turns about its
   * neighbours at no cost, and its weight has work to do on that.
   *
   * The energy is factor E/2 int |grad u - grad u(centre)|^2 over the whole
   * cell: nothing for linear fields, so it keeps the order of the linear
   * functions and leaves no force on rigid bodies.
   */
  template <int dim>
  class Hourglass
  {
  public:
    Hourglass(const ActiveNodes<dim>    &active,
              const MaterialPoints<dim> &points);

    /** Finds the cells that have too few points now. */
    void reinit();

    /** Adds the i-th of the starved cells. */
    void add(const unsigned int i, CellSystem &system) const;

    /** The places of the starved cells among the active ones, increasing. */
    const std::vector<unsigned int> &cells() const
    {
      return starved_cells;
    }

  private:
    bool                is_starved(const unsigned int k) const;
    double              points_that_count(const unsigned int k) const;
    std::vector<double> stiffness(const unsigned int k) const;

    const ActiveNodes<dim>          &active;
    const MaterialPoints<dim>       &points;
    std::vector<unsigned int>        starved_cells;
    std::vector<std::vector<double>> matrices; // n x n, the same for components
  };
} // namespace Impoint

#endif
