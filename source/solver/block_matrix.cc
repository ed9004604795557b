#include <impoint/solver/block_matrix.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  using namespace dealii;

  template <int dim>
  void BlockMatrix<dim>::reinit(const BlockPattern &new_pattern)
  {
    pattern = &new_pattern;
    values.assign(new_pattern.columns.size() * dim * dim, 0.);
  }

  template <int dim>
  void BlockMatrix<dim>::vmult(const double *x, double *y) const
  {
    for (unsigned int row = 0; row < pattern->n_rows(); ++row)
      row_vmult(*this,
                pattern->row_start[row],
                pattern->row_start[row + 1],
                x,
                y + static_cast<std::size_t>(row) * dim);
  }

  template <int dim>
  void BlockMatrix<dim>::absolute_vmult(const double *x, double *y) const
  {
    const double *entry = values.data();
    for (unsigned int row = 0; row < pattern->n_rows(); ++row)
      {
        double *sums = y + static_cast<std::size_t>(row) * dim;
        std::fill(sums, sums + dim, 0.);
        for (std::size_t k = pattern->row_start[row];
             k < pattern->row_start[row + 1];
             ++k)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              sums[i] += std::abs(*entry++ * x[pattern->columns[k] * dim + j]);
      }
  }

  template <int dim>
  double BlockMatrix<dim>::largest_entry() const
  {
    double largest = 0;
    for (const double entry : values)
      largest = std::max(largest, std::abs(entry));
    return largest;
  }

  template <int dim>
  void BlockSubmatrix<dim>::new_pattern(
    const BlockPattern              &from,
    const std::vector<unsigned int> &new_rows,
    const std::vector<unsigned int> &column_index)
  {
    rows = new_rows;
    source.clear();
    pattern.columns.clear();
    pattern.row_start.assign(1, 0);
    for (const unsigned int row : rows)
      {
        for (std::size_t k = from.row_start[row]; k < from.row_start[row + 1];
             ++k)
          if (column_index[from.columns[k]] != numbers::invalid_unsigned_int)
            {
              pattern.columns.push_back(column_index[from.columns[k]]);
              source.push_back(k);
            }
        pattern.row_start.push_back(pattern.columns.size());
      }
    matrix.reinit(pattern);
  }

  template <int dim>
  void BlockSubmatrix<dim>::copy(const BlockMatrix<dim> &from)
  {
    constexpr std::size_t block = dim * dim;
    for (std::size_t k = 0; k < source.size(); ++k)
      std::copy_n(&from.values[source[k] * block],
                  block,
                  &matrix.values[k * block]);
  }

  std::vector<std::size_t> diagonal_blocks(const BlockPattern &pattern)
  {
    std::vector<std::size_t> positions(pattern.n_rows());
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      {
        const auto begin = pattern.columns.begin() + pattern.row_start[row];
        const auto end   = pattern.columns.begin() + pattern.row_start[row + 1];
        const auto found = std::lower_bound(begin, end, row);
        Assert(found != end && *found == row,
               ExcMessage("A row of the pattern lacks its diagonal block."));
        positions[row] = found - pattern.columns.begin();
      }
    return positions;
  }

  template struct BlockMatrix<2>;
  template struct BlockMatrix<3>;
  template struct BlockSubmatrix<2>;
  template struct BlockSubmatrix<3>;
} // namespace Impoint
