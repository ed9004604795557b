#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/multigrid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

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
    find_added();
    for (std::size_t row = 0; row < diagonal.size(); ++row)
      {
        Tensor<2, dim> block;
        for (unsigned int k = 0; k < dim * dim; ++k)
          block[k / dim][k % dim] =
            matrix->values[diagonal[row] * dim * dim + k];
        for (unsigned int d = 0; d < dim; ++d)
          block[d][d] += added[row * dim + d];
        if (!(determinant(block) > 0))
          throw StepFailed("The matrix is not positive definite: a node has a "
                           "singular or negative stiffness of its own.");
        block = invert(block);
        for (unsigned int k = 0; k < dim * dim; ++k)
          inverse[row * dim * dim + k] = block[k / dim][k % dim];
      }
  }

  template <int dim>
  void GaussSeidel<dim>::find_added()
  {
    const auto sum_of_row = [this](const std::size_t  block,
                                   const unsigned int d) {
      double sum = 0;
      for (unsigned int e = 0; e < dim; ++e)
        sum += std::abs(matrix->values[(block * dim + d) * dim + e]);
      return sum;
    };
    added.assign(diagonal.size() * dim, 0.);
    for (std::size_t row = 0; row < diagonal.size(); ++row)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double sum = 0;
          for (std::size_t k = matrix->pattern->row_start[row + 1];
               matrix->pattern->columns[k - 1] >= diagonal.size();
               --k)
            sum += sum_of_row(k - 1, d);
          if (sum == 0)
            continue;
          const double own =
            matrix->values[(diagonal[row] * dim + d) * dim + d];
          sum += sum_of_row(diagonal[row], d) - 2 * own;
          added[row * dim + d] = std::max(0., sum / 2);
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
          r_row[d] = added[row * dim + d] * x[row * dim + d] - r_row[d];
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
                            const NodeExchange            &nodes,
                            const Lattice                 &lattice,
                            const std::vector<SplineLine> &lines)
  {
    make_levels(pattern, nodes, lattice, lines);
  }

  template <int dim>
  Multigrid<dim>::Multigrid(const BlockPattern         &pattern,
                            const NodeExchange         &nodes,
                            const CoveringLattice<dim> &lattice)
  {
    make_levels(pattern, nodes, lattice);
  }

  template <int dim>
  template <typename... LatticeOf>
  void Multigrid<dim>::make_levels(const BlockPattern &pattern,
                                   const NodeExchange &nodes,
                                   const LatticeOf &...lattice)
  {
    const auto count = [&](const BlockPattern &of) {
      return Utilities::MPI::sum(of.n_rows(), nodes.communicator());
    };
    unsigned int n_fine = count(pattern);
    if (n_fine * dim <= bottom_unknowns)
      {
        bottom.new_pattern(pattern, nodes);
        return;
      }
    levels.push_back(std::make_unique<Level>(pattern, nodes, lattice...));
    while (true)
      {
        const LatticeCoarsening<dim> &coarse   = levels.back()->coarsening;
        const unsigned int            n_coarse = count(coarse.pattern());
        coarsens_well &= n_coarse <= least_coarsening * n_fine;
        if (n_coarse * dim <= bottom_unknowns || !coarsens_well)
          break;
        n_fine = n_coarse;
        levels.push_back(std::make_unique<Level>(
          coarse.pattern(), coarse.nodes(), coarse.lattice(), coarse.lines()));
      }
    const LatticeCoarsening<dim> &last = levels.back()->coarsening;
    bottom.new_pattern(last.pattern(), last.nodes());
  }

  template <int dim>
  bool Multigrid<dim>::coarsens() const
  {
    return coarsens_well;
  }

  template <int dim>
  void Multigrid<dim>::new_matrix(const BlockMatrix<dim> &matrix)
  {
    const BlockMatrix<dim> *current = &matrix;
    for (const std::unique_ptr<Level> &level : levels)
      {
        on_all_ranks(level->nodes.communicator(),
                     [&]() { level->smoother.reinit(*current); });
        level->residual.resize(current->pattern->n_rows() * dim);
        level->coarsening.galerkin(*current, level->coarse_matrix);
        current = &level->coarse_matrix;
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
    level.nodes.update(x);
    level.smoother.residual(x, level.residual);
    level.coarsening.restrict(level.residual, level.coarse_right);
    solve_coarse(level_index, level);
    level.coarsening.prolongate(level.coarse_solution, x);
    level.nodes.update(x);
    level.smoother.backward(b, x);
  }

  /** Two cycles of the levels below, unless these are but a factor: one alone
   * falls behind on slender bodies, which the functions of a lattice with
   * larger cells can't bend (iterations of a beam of 8 : 1 : 1 grow from 13 to
   * 17 in place of 12 to 12 from 1e4 to 1e5 unknowns). */
  template <int dim>
  void Multigrid<dim>::solve_coarse(const unsigned int level_index,
                                    const Level       &level) const
  {
    std::vector<double> &right = level.coarse_right, &x = level.coarse_solution;
    x.resize(level.coarsening.lattice().size() * dim);
    cycle(level_index + 1, right, x);
    if (level_index + 1 == levels.size())
      return;

    level.coarsening.nodes().update(x);
    std::vector<double> &product = level.coarse_product,
                        &change  = level.coarse_change;
    product.resize(level.coarse_matrix.pattern->n_rows() * dim);
    level.coarse_matrix.vmult(x.data(), product.data());
    for (std::size_t i = 0; i < product.size(); ++i)
      right[i] -= product[i];
    change.resize(x.size());
    cycle(level_index + 1, right, change);
    for (std::size_t i = 0; i < product.size(); ++i)
      x[i] += change[i];
  }

  template class GaussSeidel<2>;
  template class GaussSeidel<3>;
  template class Multigrid<2>;
  template class Multigrid<3>;
} // namespace Impoint
