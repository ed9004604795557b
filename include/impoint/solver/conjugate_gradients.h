#ifndef impoint_solver_conjugate_gradients_h
#define impoint_solver_conjugate_gradients_h

#include <impoint/solver/block_matrix.h>
#include <impoint/solver/node_exchange.h>

#include <vector>

namespace Impoint
{
  /**
   * A symmetric positive definite approximation of an inverse. Vectors are
   * those of the nodes that a rank owns; room for ghosts may follow, whose
   * values are not used.
   */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    /** z = M r; z has the size of r. Collective if it serves several ranks. */
    virtual void vmult(const std::vector<double> &r,
                       std::vector<double>       &z) const = 0;

    /**
     * What solves for a part of the unknowns exactly starts the iteration from
     * that part of the solution, in @p x, which was zero: the residual of these
     * unknowns then stays zero but for round-off, which clear() takes away, and
     * finish() finds them in the end from all others, ghosts included. Returns
     * whether it is so.
     */
    virtual bool start(const std::vector<double> & /*b*/,
                       std::vector<double> & /*x*/) const
    {
      return false;
    }
    virtual void clear(std::vector<double> & /*r*/) const
    {}
    virtual void finish(const std::vector<double> & /*b*/,
                        std::vector<double> & /*x*/) const
    {}
  };

  struct IterationControl
  {
    /** Reduction of the preconditioned residual sqrt(r . M r) to reach. */
    double       tolerance      = 1e-10;
    double       reference      = 0; // at least what reductions refer to
    unsigned int max_iterations = 500;

    /** Whether to stop as soon as the pace so far shows that max_iterations
     * will not do (where another preconditioner stands by). */
    bool give_up_early = false;
  };

  struct IterationResult
  {
    unsigned int iterations = 0;
    bool         converged  = false;
    double       reduction  = 1; // of the preconditioned residual
    double       start      = 0; // what that was
  };

  /**
   * Solves A x = b from x = 0, the rows being those of the nodes owned among
   * @p nodes. Collective. The preconditioned residual decides, for the
   * residual itself stalls at round-off of the stiffest entries. Throws
   * StepFailed if A (or M) turns out not to be positive definite.
   */
  template <int dim>
  IterationResult conjugate_gradients(const BlockMatrix<dim>    &matrix,
                                      const NodeExchange        &nodes,
                                      const Preconditioner      &preconditioner,
                                      const std::vector<double> &b,
                                      const IterationControl    &control,
                                      std::vector<double>       &x);
} // namespace Impoint

#endif
