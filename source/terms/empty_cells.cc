#include <impoint/terms/empty_cells.h>

#include <deal.II/base/quadrature_lib.h>

namespace Impoint
{
  template <int dim>
  EmptyCells<dim>::EmptyCells(const ActiveNodes<dim> &active,
                              const double            young)
    : active(active)
    , young(young)
  {}



  template <int dim>
  void EmptyCells<dim>::reinit()
  {
    matrices.assign(active.n_cells() - active.n_material_cells(), {});
    for (unsigned int e = 0; e < matrices.size(); ++e)
      integrate(active.cell(active.n_material_cells() + e), matrices[e]);
  }



  /** E/2 (grad_a . grad_b I + grad_b x grad_a): elasticity with nu = 0, whose
   * normal part E g_a x g_b needs no term of its own. */
  template <int dim>
  void EmptyCells<dim>::integrate(const unsigned int   c,
                                  std::vector<double> &matrix) const
  {
    const auto        &basis = active.basis();
    const unsigned int n     = basis.n_nodes_of(c);
    matrix.assign(n * n * dim * dim, 0.);
    std::vector<double>   support(basis.support_size(c));
    const Quadrature<dim> rule =
      basis.grid().simplicial() ?
        static_cast<Quadrature<dim>>(QGaussSimplex<dim>(basis.degree())) :
        static_cast<Quadrature<dim>>(QGauss<dim>(basis.degree() + 1));
    double rule_volume = 0;
    for (const double weight : rule.get_weights())
      rule_volume += weight;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        basis.evaluate(c, rule.point(q), support.data());
        const double *gradients = support.data() + n;
        const double  factor =
          0.5 * young * rule.weight(q) / rule_volume * basis.grid().volume(c);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            {
              const double *g_a   = gradients + a * dim;
              const double *g_b   = gradients + b * dim;
              double       *block = matrix.data() + (a * n + b) * dim * dim;
              double        dot   = 0;
              for (unsigned int d = 0; d < dim; ++d)
                dot += g_a[d] * g_b[d];
              for (unsigned int i = 0; i < dim; ++i)
                {
                  block[i * dim + i] += factor * dot;
                  for (unsigned int j = 0; j < dim; ++j)
                    block[i * dim + j] += factor * g_b[i] * g_a[j];
                }
            }
      }
  }



  template <int dim>
  void EmptyCells<dim>::add(const unsigned int k,
                            const bool         moves_freely,
                            CellSystem        &system) const
  {
    constexpr double           ridge  = 1e-9;
    const std::vector<double> &matrix = matrices[k - active.n_material_cells()];
    const unsigned int         n      = system.n;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              const unsigned int at = (a * n + b) * dim * dim + i * dim + j;
              system.residual[a * dim + i] +=
                matrix[at] * system.u[b * dim + j];
              if (system.matrix)
                system.matrix[at] +=
                  matrix[at] *
                  (moves_freely && a == b && i == j ? 1. + ridge : 1.);
            }
  }

  template class EmptyCells<2>;
  template class EmptyCells<3>;
} // namespace Impoint
