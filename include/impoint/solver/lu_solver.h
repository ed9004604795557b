#ifndef impoint_solver_lu_solver_h
#define impoint_solver_lu_solver_h

#include <impoint/solver/block_matrix.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * A sparse LU factor (UMFPACK) of matrices on a symmetric pattern whose
   * values are not symmetric, analysed once a pattern.
   */
  template <int dim>
  class LuSolver
  {
  public:
    LuSolver();
    ~LuSolver();

    /** Throws RunFailed if memory does not hold what it takes. */
    void new_pattern(const BlockPattern &pattern);

    /** Returns false if the matrix is singular; the factor is of no use then.
     */
    bool factorize(const BlockMatrix<dim> &matrix);

    /** x = A^-1 b. */
    void vmult(const std::vector<double> &b, std::vector<double> &x) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace Impoint

#endif
