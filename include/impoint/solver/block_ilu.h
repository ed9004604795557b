#ifndef impoint_solver_block_ilu_h
#define impoint_solver_block_ilu_h

#include <impoint/solver/conjugate_gradients.h>

namespace Impoint
{
  /**
   * Incomplete factors of a matrix on the matrix's own pattern, by blocks of a
   * node: an approximation of its inverse where mass makes it diagonally
   * dominant, as in the short steps of a flow. Not symmetric in general. Each
   * of several ranks has the factors of its own rows and columns.
   */
  template <int dim>
  class BlockIlu : public Preconditioner
  {
  public:
    /** Returns false if a block on the diagonal turns out singular. */
    bool factorize(const BlockMatrix<dim> &matrix);

    void vmult(const std::vector<double> &r,
               std::vector<double>       &z) const override;

    /**
     * Solves A x = b from x = 0 by stabilised biconjugate gradients (H. van der
     * Vorst, 1992), to a residual of @p tolerance relative to b. Gives up
     * where they break down or a factorisation would be cheaper. Collective.
     */
    IterationResult solve(const BlockMatrix<dim>    &matrix,
                          const NodeExchange        &nodes,
                          const std::vector<double> &b,
                          const double               tolerance,
                          std::vector<double>       &x) const;

  private:
    BlockMatrix<dim>         factors; // on the diagonal: inverses
    std::vector<std::size_t> diagonal;
    std::vector<std::size_t> ends; // of the rows, but for ghosts
  };
} // namespace Impoint

#endif
