#ifndef impoint_solver_direct_solver_h
#define impoint_solver_direct_solver_h

#include <impoint/solver/conjugate_gradients.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Impoint
{
  /**
   * A sparse Cholesky factor (CHOLMOD), ordered and analysed once a pattern.
   */
  template <int dim>
  class DirectSolver : public Preconditioner
  {
  public:
    DirectSolver();
    ~DirectSolver() override;

    /** Orders the unknowns and analyses the fill. Throws RunFailed if the
     * factor has more entries than CHOLMOD can count or memory holds. */
    void new_pattern(const BlockPattern &pattern);

    /**
     * Factorises matrix + diag(ridge), with ridge per node (empty: zero).
     * Returns the node whose pivot is not positive, if any; the factor is of
     * no use then.
     */
    std::optional<unsigned int>
    factorize(const BlockMatrix<dim>    &matrix,
              const std::vector<double> &ridge = {});

    /** x = A^-1 b by one forward and one backward substitution. */
    void vmult(const std::vector<double> &b,
               std::vector<double>       &x) const override;

    /** How many times longer a factorisation takes than a solve: an estimate
     * from operation counts, so that decisions on it are reproducible. */
    double solves_per_factorisation() const;

    bool supernodal() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace Impoint

#endif
