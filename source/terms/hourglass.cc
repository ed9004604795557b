#include <impoint/terms/hourglass.h>

#include <deal.II/base/quadrature_lib.h>

namespace Impoint
{
  namespace
  {
    // Of Young's modulus. Measured on the cantilever in rotated grids: the
    // error does not depend on it between 0.01 and 1.
    constexpr double hourglass_factor = 0.1;
  } // namespace



  template <int dim>
  Hourglass<dim>::Hourglass(const ActiveNodes<dim> &active, const double young)
    : active(active)
    , young(young)
  {}



  template <int dim>
  void Hourglass<dim>::reinit(const std::vector<unsigned int> &starved)
  {
    const auto         &basis = active.basis();
    const QGauss<dim>   rule(2);
    std::vector<double> support, centre;
    Point<dim>          middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 0.5;

    starved_cells = starved;
    matrices.assign(starved.size(), {});
    for (unsigned int i = 0; i < starved.size(); ++i)
      {
        const unsigned int c = active.cell(starved[i]);
        const unsigned int n = basis.n_nodes_of(c);
        support.resize(basis.support_size(c));
        centre.resize(basis.support_size(c));
        matrices[i].assign(n * n, 0.);
        basis.evaluate(c, middle, centre.data());
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            basis.evaluate(c, rule.point(q), support.data());
            const double weight = hourglass_factor * young * rule.weight(q) *
                                  basis.grid().volume(c);
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int b = 0; b < n; ++b)
                for (unsigned int d = 0; d < dim; ++d)
                  matrices[i][a * n + b] +=
                    weight *
                    (support[n + a * dim + d] - centre[n + a * dim + d]) *
                    (support[n + b * dim + d] - centre[n + b * dim + d]);
          }
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
