#ifndef impoint_solver_block_ilu_h
#define impoint_solver_block_ilu_h

#include <impoint/solver/conjugate_gradients.h>

namespace Impoint
{
  /**
   * Incomplete factors of a matrix on the matrix's own pattern, by blocks of a
   * node: an approximation of its inverse where mass makes it diagonally
   * dominant, as in the short steps of a flow. Not symmetric in general.
   */
  template <int dim>
  class BlockIlu : public Preconditioner
  {
  public:
    /** Returns false if a block on the diagonal turns out singular. */
    bool factorize(const BlockMatrix<dim> &matrix);

    void vmult(const std::vector<double> &r,
               std::vector<double>       &z) const override;

  private:
    BlockMatrix<dim>         factors; // on the diagonal: inverses
    std::vector<std::size_t> diagonal;
  };

  /**
   * Solves A x = b from x = 0 for a matrix that is not symmetric, by stabilised
   * biconjugate gradients (H. van der Vorst, 1992). Gives up where they break
   * down.
   */
  template <int dim>
  IterationResult
  stabilised_biconjugate_gradients(const BlockMatrix<dim>    &matrix,
                                   const Preconditioner      &preconditioner,
                                   const std::vector<double> &b,
                                   const IterationControl    &control,
                                   std::vector<double>       &x);
} // namespace Impoint

#endif
