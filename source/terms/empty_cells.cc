#include <impoint/terms/empty_cells.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  template <int dim>
  EmptyCells<dim>::EmptyCells(const ActiveNodes<dim> &active, const bool linear)
    : active(active)
    , linear(linear)
  {}



  template <int dim>
  void EmptyCells<dim>::reinit()
  {
    points.clear();
    for (unsigned int k = active.n_material_cells(); k < active.n_cells(); ++k)
      points.push_back(integrate(active.cell(k)));
  }



  template <int dim>
  std::vector<typename EmptyCells<dim>::Gradients>
  EmptyCells<dim>::integrate(const unsigned int c) const
  {
    const auto           &basis = active.basis();
    const unsigned int    n     = basis.n_nodes_of(c);
    std::vector<double>   support(basis.support_size(c));
    const Quadrature<dim> rule =
      basis.grid().simplicial() ?
        static_cast<Quadrature<dim>>(QGaussSimplex<dim>(basis.degree())) :
        static_cast<Quadrature<dim>>(QGauss<dim>(basis.degree() + 1));
    double rule_volume = 0;
    for (const double weight : rule.get_weights())
      rule_volume += weight;
    std::vector<Gradients> result(rule.size());
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        basis.evaluate(c, rule.point(q), support.data());
        result[q].volume =
          rule.weight(q) / rule_volume * basis.grid().volume(c);
        result[q].of_nodes.resize(n);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            result[q].of_nodes[a][d] = support[n + a * dim + d];
      }
    return result;
  }



  /** Residual V F S g_a with S = E (F^T F - 1) / 2, E being @p modulus;
   * block (a, b) of its
   * derivative V (g_a . S g_b 1 + E/2 (g_a . g_b F F^T + F g_b x F g_a)). */
  template <int dim>
  void EmptyCells<dim>::add_point(const Gradients &gradients,
                                  const double     modulus,
                                  CellSystem      &system) const
  {
    const unsigned int n = system.n;
    Tensor<2, dim>     F;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        F[i] += system.u[a * dim + i] * gradients.of_nodes[a];
    Tensor<2, dim>       strain = 0.5 * (F + transpose(F));
    const Tensor<2, dim> one    = unit_symmetric_tensor<dim>();
    if (linear)
      F = one;
    else
      {
        strain += 0.5 * transpose(F) * F;
        F += one;
      }
    const Tensor<2, dim> S = gradients.volume * modulus * strain,
                         B =
                           0.5 * gradients.volume * modulus * F * transpose(F);
    std::vector<Tensor<1, dim>> pushed(n);
    for (unsigned int a = 0; a < n; ++a)
      {
        const Tensor<1, dim> &g     = gradients.of_nodes[a];
        const Tensor<1, dim>  force = F * (S * g);
        pushed[a]                   = F * g;
        for (unsigned int i = 0; i < dim; ++i)
          system.residual[a * dim + i] += force[i];
      }
    if (system.matrix == nullptr)
      return;
    const double factor = 0.5 * gradients.volume * modulus;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        {
          const Tensor<1, dim> &g_a = gradients.of_nodes[a],
                               &g_b = gradients.of_nodes[b];
          const double dot          = g_a * g_b,
                       geometric    = linear ? 0. : g_a * (S * g_b);
          double *block             = system.matrix + (a * n + b) * dim * dim;
          for (unsigned int i = 0; i < dim; ++i)
            {
              block[i * dim + i] += geometric;
              for (unsigned int j = 0; j < dim; ++j)
                block[i * dim + j] +=
                  dot * B[i][j] + factor * pushed[b][i] * pushed[a][j];
            }
        }
  }



  template <int dim>
  void EmptyCells<dim>::add(const unsigned int k,
                            const double       young,
                            CellSystem        &system) const
  {
    for (const Gradients &point : points[k - active.n_material_cells()])
      add_point(point, young, system);
  }



  template <int dim>
  void EmptyCells<dim>::anchor(CellSystem &system) const
  {
    constexpr double   part = 1e-6; // of the cell's own stiffness
    const unsigned int n    = system.n;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          double &entry = system.matrix[(a * n + a) * dim * dim + i * dim + i];
          entry += part * std::abs(entry);
        }
  }

  template class EmptyCells<2>;
  template class EmptyCells<3>;
} // namespace Impoint
