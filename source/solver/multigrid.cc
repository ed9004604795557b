#include <impoint/base/exceptions.h>
#include <impoint/solver/multigrid.h>

#include <deal.II/base/tensor.h>

#include <algorithm>

namespace Impoint
{
  using namespace dealii;

  namespace
  {
    /** Up to here a factor is cheaper than a further level. */
    constexpr unsigned int bottom_unknowns = 600;

    /** Debris on scattered cells does not coarsen: levels that keep more than
     * this part of the nodes are not worth their sweeps. */
    constexpr double least_coarsening = 0.75;

    /** A coarse node whose even neighbours were left out can make columns of
     * P dependent. Their null space does not reach the fine lattice, so this
     * relative ridge is harmless. */
    constexpr double bottom_ridge = 1e-10;
  } // namespace

  template <int dim>
  void GaussSeidel<dim>::reinit(const BlockMatrix<dim> &new_matrix)
  {
    matrix   = &new_matrix;
    diagonal = diagonal_blocks(*matrix->pattern);
    inverse.resize(diagonal.size() * dim * dim);
    for (std::size_t row = 0; row < diagonal.size(); ++row)
      {
        Tensor<2, dim> block;
        for (unsigned int k = 0; k < dim * dim; ++k)
          block[k / dim][k % dim] =
            matrix->values[diagonal[row] * dim * dim + k];
        if (!(determinant(block) > 0))
          throw StepFailed("The matrix is not positive definite: a node has a "
                           "singular or negative stiffness of its own.");
        block = invert(block);
        for (unsigned int k = 0; k < dim * dim; ++k)
          inverse[row * dim * dim + k] = block[k / dim][k % dim];
      }
  }

  template <int dim>
  void GaussSeidel<dim>::solve_diagonal(const unsigned int row, double *x) const
  {
    double right[dim];
    std::copy(x, x + dim, right);
    std::fill(x, x + dim, 0.);
    add_block_vmult<dim>(&inverse[static_cast<std::size_t>(row) * dim * dim],
                         right,
                         1.,
                         x);
  }

  template <int dim>
  void GaussSeidel<dim>::forward(const std::vector<double> &b,
                                 std::vector<double>       &x) const
  {
    for (unsigned int row = 0; row < diagonal.size(); ++row)
      {
        double  sum[dim];
        double *x_row = &x[static_cast<std::size_t>(row) * dim];
        row_vmult(*matrix,
                  matrix->pattern->row_start[row],
                  diagonal[row],
                  x.data(),
                  sum);
        for (unsigned int d = 0; d < dim; ++d)
          x_row[d] = b[static_cast<std::size_t>(row) * dim + d] - sum[d];
        solve_diagonal(row, x_row);
      }
  }

  template <int dim>
  void GaussSeidel<dim>::residual(const std::vector<double> &x,
                                  std::vector<double>       &r) const
  {
    for (unsigned int row = 0; row < diagonal.size(); ++row)
      {
        double *r_row = &r[static_cast<std::size_t>(row) * dim];
        row_vmult(*matrix,
                  diagonal[row] + 1,
                  matrix->pattern->row_start[row + 1],
                  x.data(),
                  r_row);
        for (unsigned int d = 0; d < dim; ++d)
          r_row[d] = -r_row[d];
      }
  }

  template <int dim>
  void GaussSeidel<dim>::backward(const std::vector<double> &b,
                                  std::vector<double>       &x) const
  {
    for (unsigned int row = diagonal.size(); row-- > 0;)
      {
        double  sum[dim];
        double *x_row = &x[static_cast<std::size_t>(row) * dim];
        row_vmult(*matrix,
                  matrix->pattern->row_start[row],
                  matrix->pattern->row_start[row + 1],
                  x.data(),
                  sum);
        for (unsigned int d = 0; d < dim; ++d)
          sum[d] = b[static_cast<std::size_t>(row) * dim + d] - sum[d];
        add_block_vmult<dim>(
          &inverse[static_cast<std::size_t>(row) * dim * dim], sum, 1., x_row);
      }
  }

  template <int dim>
  Multigrid<dim>::Multigrid(const BlockPattern            &pattern,
                            const Lattice                 &lattice,
                            const std::vector<SplineLine> &lines)
  {
    const BlockPattern            *current         = &pattern;
    const Lattice                 *current_lattice = &lattice;
    const std::vector<SplineLine> *current_lines   = &lines;
    while (current->n_rows() * dim > bottom_unknowns)
      {
        levels.push_back(
          std::make_unique<Level>(*current, *current_lattice, *current_lines));
        const unsigned int n_fine = current->n_rows();
        current                   = &levels.back()->coarsening.pattern();
        current_lattice           = &levels.back()->coarsening.lattice();
        current_lines             = &levels.back()->coarsening.lines();
        if (current->n_rows() > least_coarsening * n_fine)
          break;
      }
    bottom.new_pattern(*current);
  }

  template <int dim>
  void Multigrid<dim>::new_matrix(const BlockMatrix<dim> &matrix)
  {
    const BlockMatrix<dim> *current = &matrix;
    for (const std::unique_ptr<Level> &level : levels)
      {
        const std::size_t n_fine = current->pattern->n_rows() * dim;
        level->smoother.reinit(*current);
        level->coarsening.galerkin(*current, level->coarse_matrix);
        current = &level->coarse_matrix;
        level->residual.resize(n_fine);
        level->coarse_solution.resize(current->pattern->n_rows() * dim);
      }

    const std::vector<std::size_t> diagonal =
      diagonal_blocks(*current->pattern);
    std::vector<double> ridge(diagonal.size(), 0.);
    for (std::size_t node = 0; node < ridge.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        ridge[node] = std::max(
          ridge[node],
          bottom_ridge *
            current->values[diagonal[node] * dim * dim + d * (dim + 1)]);
    if (bottom.factorize(*current, ridge))
      throw StepFailed("The matrix is not positive definite: its coarsest "
                       "multigrid level has no Cholesky factor. A body without "
                       "sufficient supports or a material that softens brings "
                       "this about.");
  }

  template <int dim>
  void Multigrid<dim>::vmult(const std::vector<double> &r,
                             std::vector<double>       &z) const
  {
    z.resize(r.size());
    cycle(0, r, z);
  }

  template <int dim>
  void Multigrid<dim>::cycle(const unsigned int         level_index,
                             const std::vector<double> &b,
                             std::vector<double>       &x) const
  {
    if (level_index == levels.size())
      {
        bottom.vmult(b, x);
        return;
      }
    const Level &level = *levels[level_index];
    level.smoother.forward(b, x);
    level.smoother.residual(x, level.residual);
    level.coarsening.restrict(level.residual, level.coarse_right);
    cycle(level_index + 1, level.coarse_right, level.coarse_solution);
    level.coarsening.prolongate(level.coarse_solution, x);
    level.smoother.backward(b, x);
  }

  template class GaussSeidel<2>;
  template class GaussSeidel<3>;
  template class Multigrid<2>;
  template class Multigrid<3>;
} // namespace Impoint
