#ifndef impoint_solver_block_matrix_h
#define impoint_solver_block_matrix_h

#include <impoint/base/block_pattern.h>

#include <cstddef>
#include <vector>

namespace Impoint
{
  /**
   * A square matrix of dim x dim blocks on a BlockPattern that outlives it.
   * Block k occupies values[k*dim*dim ...] row-major.
   */
  template <int dim>
  struct BlockMatrix
  {
    void reinit(const BlockPattern &pattern);     // zero
    void vmult(const double *x, double *y) const; // y = A x

    /** y = |A| |x|, by absolute values of all entries: what round-off in A x is
     * a part of. */
    void absolute_vmult(const double *x, double *y) const;

    double largest_entry() const; // in absolute value

    const BlockPattern *pattern = nullptr;
    std::vector<double> values;
  };

  /**
   * Some rows of a matrix on some of its columns, with a pattern of its own.
   * Rectangular in general; square if both are the same nodes.
   */
  template <int dim>
  struct BlockSubmatrix
  {
    /** The columns to leave out have column_index
     * numbers::invalid_unsigned_int; that of the others must grow with the
     * column, so that rows stay sorted. */
    void new_pattern(const BlockPattern              &from,
                     const std::vector<unsigned int> &rows,
                     const std::vector<unsigned int> &column_index);

    /** Takes the values from @p from, on the pattern given before. */
    void copy(const BlockMatrix<dim> &from);

    std::vector<unsigned int> rows;
    BlockPattern              pattern;
    BlockMatrix<dim>          matrix;
    std::vector<std::size_t>  source; // per block: where it stands in from
  };

  /** The position of the diagonal block of each row of a square matrix. */
  std::vector<std::size_t> diagonal_blocks(const BlockPattern &pattern);

  // The kernels below stand in the header for the compiler to unroll them.

  /** y += factor a x for one block. */
  template <int dim>
  inline void add_block_vmult(const double *a,
                              const double *x,
                              const double  factor,
                              double       *y)
  {
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c < dim; ++c)
        y[r] += factor * a[r * dim + c] * x[c];
  }

  /** y += factor a^T x for one block. */
  template <int dim>
  inline void add_block_transposed_vmult(const double *a,
                                         const double *x,
                                         const double  factor,
                                         double       *y)
  {
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c < dim; ++c)
        y[c] += factor * a[r * dim + c] * x[r];
  }

  /** y = sum of the blocks [begin, end) of a row times x. The products are
   * summed by entry first: dim*dim independent chains of additions. */
  template <int dim>
  inline void row_vmult(const BlockMatrix<dim> &matrix,
                        const std::size_t       begin,
                        const std::size_t       end,
                        const double           *x,
                        double                 *y)
  {
    double sum[dim * dim] = {};
    for (std::size_t k = begin; k < end; ++k)
      {
        const double *a = &matrix.values[k * dim * dim];
        const double *x_column =
          x + static_cast<std::size_t>(matrix.pattern->columns[k]) * dim;
        for (int r = 0; r < dim; ++r)
          for (int c = 0; c < dim; ++c)
            sum[r * dim + c] += a[r * dim + c] * x_column[c];
      }
    for (int r = 0; r < dim; ++r)
      {
        y[r] = 0;
        for (int c = 0; c < dim; ++c)
          y[r] += sum[r * dim + c];
      }
  }
} // namespace Impoint

#endif
