#include <impoint/solver/block_ilu.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Impoint
{
  using namespace dealii;

  namespace
  {
    /** In place. Returns false for a singular block. */
    template <int dim>
    bool invert_block(double *a)
    {
      Tensor<2, dim> block;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          block[i][j] = a[i * dim + j];
      const double size = block.norm();
      if (!(std::abs(determinant(block)) > 1e-14 * std::pow(size, dim)))
        return false;
      const Tensor<2, dim> inverse = invert(block);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          a[i * dim + j] = inverse[i][j];
      return true;
    }



    /** c = a b */
    template <int dim>
    void multiply(const double *a, const double *b, double *c)
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            c[i * dim + j] = 0;
            for (int k = 0; k < dim; ++k)
              c[i * dim + j] += a[i * dim + k] * b[k * dim + j];
          }
    }



    double dot_product(const std::vector<double> &a,
                       const std::vector<double> &b,
                       const NodeExchange        &nodes)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return Utilities::MPI::sum(sum, nodes.communicator());
    }



    /** Where each row's columns of other ranks begin: they are the last. */
    std::vector<std::size_t> ends_of_rows(const BlockPattern &pattern)
    {
      std::vector<std::size_t> ends;
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        ends.push_back(
          std::lower_bound(pattern.columns.begin() + pattern.row_start[row],
                           pattern.columns.begin() + pattern.row_start[row + 1],
                           pattern.n_rows()) -
          pattern.columns.begin());
      return ends;
    }
  } // namespace



  template <int dim>
  bool BlockIlu<dim>::factorize(const BlockMatrix<dim> &matrix)
  {
    constexpr int n_entries = dim * dim;
    factors                 = matrix;
    const auto &pattern     = *matrix.pattern;
    diagonal                = diagonal_blocks(pattern);
    ends                    = ends_of_rows(pattern);
    const auto none         = std::numeric_limits<std::size_t>::max();

    std::vector<std::size_t> place(pattern.n_rows(), none); // in this row
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      {
        const auto begin = pattern.row_start[row], end = ends[row];
        for (std::size_t k = begin; k < end; ++k)
          place[pattern.columns[k]] = k;
        for (std::size_t k = begin; k < diagonal[row]; ++k)
          {
            const unsigned int above = pattern.columns[k];
            double            *lower = &factors.values[k * n_entries];
            double             part[n_entries], product[n_entries];
            std::copy_n(lower, n_entries, part);
            multiply<dim>(part,
                          &factors.values[diagonal[above] * n_entries],
                          lower);
            for (std::size_t q = diagonal[above] + 1; q < ends[above]; ++q)
              {
                const std::size_t to = place[pattern.columns[q]];
                if (to == none)
                  continue;
                multiply<dim>(lower, &factors.values[q * n_entries], product);
                for (int e = 0; e < n_entries; ++e)
                  factors.values[to * n_entries + e] -= product[e];
              }
          }
        for (std::size_t k = begin; k < end; ++k)
          place[pattern.columns[k]] = none;
        if (!invert_block<dim>(&factors.values[diagonal[row] * n_entries]))
          return false;
      }
    return true;
  }



  template <int dim>
  void BlockIlu<dim>::vmult(const std::vector<double> &r,
                            std::vector<double>       &z) const
  {
    const auto &pattern = *factors.pattern;
    z.resize(r.size());
    double sum[dim];
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      {
        row_vmult<dim>(
          factors, pattern.row_start[row], diagonal[row], z.data(), sum);
        for (int d = 0; d < dim; ++d)
          z[row * dim + d] = r[row * dim + d] - sum[d];
      }
    for (unsigned int row = pattern.n_rows(); row-- > 0;)
      {
        double *x = &z[row * dim];
        row_vmult<dim>(factors, diagonal[row] + 1, ends[row], z.data(), sum);
        for (int d = 0; d < dim; ++d)
          sum[d] = x[d] - sum[d];
        std::fill(x, x + dim, 0.);
        add_block_vmult<dim>(&factors.values[diagonal[row] * dim * dim],
                             sum,
                             1.,
                             x);
      }
  }



  // Preconditioned from the right: the residual is the true one.
  template <int dim>
  IterationResult BlockIlu<dim>::solve(const BlockMatrix<dim>    &matrix,
                                       const NodeExchange        &nodes,
                                       const std::vector<double> &b,
                                       const double               tolerance,
                                       std::vector<double>       &x) const
  {
    constexpr unsigned int    most = 30, probation = 10; // for the first digit
    IterationResult           result;
    const std::size_t         n = b.size();
    std::vector<double>       r = b, p(n, 0.), v(n, 0.), p_hat, r_hat, t(n);
    const std::vector<double> shadow = b;
    const auto                dot    = [&nodes](const std::vector<double> &f,
                              const std::vector<double> &g) {
      return dot_product(f, g, nodes);
    };
    const auto multiply_with_ghosts = [&](std::vector<double> &f,
                                          std::vector<double> &product) {
      f.resize(n + std::size_t(nodes.n_ghosts()) * dim);
      nodes.update(f);
      matrix.vmult(f.data(), product.data());
    };
    const double size = std::sqrt(dot(b, b));
    x.assign(n, 0.);
    result.converged = size == 0;
    double rho = 1, alpha = 1, omega = 1;
    while (!result.converged && result.iterations < most)
      {
        const double next = dot(shadow, r);
        const double beta = next / rho * (alpha / omega);
        rho               = next;
        for (std::size_t i = 0; i < n; ++i)
          p[i] = r[i] + beta * (p[i] - omega * v[i]);
        vmult(p, p_hat);
        multiply_with_ghosts(p_hat, v);
        alpha = rho / dot(shadow, v);
        for (std::size_t i = 0; i < n; ++i)
          r[i] -= alpha * v[i];
        vmult(r, r_hat);
        multiply_with_ghosts(r_hat, t);
        const double square = dot(t, t);
        omega               = square > 0 ? dot(t, r) / square : 0.;
        for (std::size_t i = 0; i < n; ++i)
          {
            x[i] += alpha * p_hat[i] + omega * r_hat[i];
            r[i] -= omega * t[i];
          }
        ++result.iterations;
        result.reduction = std::sqrt(dot(r, r)) / size;
        result.converged = result.reduction <= tolerance;
        if (!std::isfinite(result.reduction) ||
            (omega == 0 && !result.converged) ||
            (result.iterations == probation && result.reduction > 0.1))
          break;
      }
    return result;
  }

  template class BlockIlu<2>;
  template class BlockIlu<3>;
} // namespace Impoint
