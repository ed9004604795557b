#include <impoint/terms/hourglass.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    // Of Young's modulus. Measured on the cantilever in rotated grids: the
    // error does not depend on it between 0.01 and 1.
    constexpr double hourglass_factor = 0.1;
  } // namespace



  template <int dim>
  Hourglass<dim>::Hourglass(const ActiveNodes<dim>    &active,
                            const MaterialPoints<dim> &points)
    : active(active)
    , points(points)
  {}



  /** How many points the active cell @p k has, if they have equal volumes; less
   * if some have next to none: what they see costs next to nothing. */
  template <int dim>
  double Hourglass<dim>::points_that_count(const unsigned int k) const
  {
    double sum = 0, squares = 0;
    for (unsigned int p = points.ranges()[k].begin; p < points.ranges()[k].end;
         ++p)
      {
        const double volume = points.data(p)[points.slots().volume];
        sum += volume;
        squares += volume * volume;
      }
    return sum * sum / squares;
  }



  /** Simplices see all their modes with one point. Elsewhere as many strains as
   * modes are not enough: points may lie on a line. */
  template <int dim>
  bool Hourglass<dim>::is_starved(const unsigned int k) const
  {
    constexpr double       round_off = 1e-6;
    constexpr unsigned int n_rigid   = dim * (dim + 1) / 2;
    const unsigned int     n         = active.nodes(k).size();
    return n > dim + 1 &&
           points_that_count(k) * Voigt<dim>::n < n * dim - n_rigid + round_off;
  }



  /** Of the active cell @p k: n x n, the same for all components. */
  template <int dim>
  std::vector<double> Hourglass<dim>::stiffness(const unsigned int k) const
  {
    const unsigned int c     = active.cell(k);
    double             young = 0;
    for (unsigned int p = points.ranges()[k].begin; p < points.ranges()[k].end;
         ++p)
      young = std::max(young, points.material(p).young());
    const auto       &basis = active.basis();
    const QGauss<dim> rule(2);
    Point<dim>        middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 0.5;
    const unsigned int  n = basis.n_nodes_of(c);
    std::vector<double> support(basis.support_size(c)), centre(support),
      matrix(n * n, 0.);
    basis.evaluate(c, middle, centre.data());
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        basis.evaluate(c, rule.point(q), support.data());
        const double weight = hourglass_factor * young *
                              points.carried().thickness * rule.weight(q) *
                              basis.grid().volume(c);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              matrix[a * n + b] +=
                weight * (support[n + a * dim + d] - centre[n + a * dim + d]) *
                (support[n + b * dim + d] - centre[n + b * dim + d]);
      }
    return matrix;
  }



  template <int dim>
  void Hourglass<dim>::reinit()
  {
    starved_cells.clear();
    matrices.clear();
    // Only linear functions: splines have about one function a cell, seen from
    // several cells, and this would not leave quadratic fields alone.
    if (active.basis().degree() > 1)
      return;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      if (is_starved(k))
        {
          starved_cells.push_back(k);
          matrices.push_back(stiffness(k));
        }
  }



  template <int dim>
  void Hourglass<dim>::add(const unsigned int i, CellSystem &system) const
  {
    add_for_components<dim>(matrices[i], 1., system.u, 1., system);
  }

  template class Hourglass<2>;
  template class Hourglass<3>;
} // namespace Impoint
