#ifndef impoint_solver_linear_solver_h
#define impoint_solver_linear_solver_h

#include <impoint/base/counters.h>
#include <impoint/grid/spline_line.h>
#include <impoint/solver/block_matrix.h>
#include <impoint/solver/node_exchange.h>

#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  class ParameterFile;

  struct LinearSolverParameters
  {
    void declare(ParameterFile &file);

    /** The tolerance times @p looser, within reason. */
    double loosened(const double looser) const;

    std::string  kind             = "automatic"; // automatic|direct|iterative
    double       tolerance        = 1e-12;
    unsigned int max_iterations   = 500;
    double       sliver           = 1e-5; // of the median diagonal
    unsigned int renew_iterations = 30;   // old preconditioner kept up to here
  };

  /**
   * A linear problem on the active nodes, as the solver sees it: dim unknowns a
   * node, conforming conditions already eliminated (rows and columns zero but
   * for the diagonal). Several ranks have the rows of the nodes they own; what
   * is said of nodes, they know of the ghosts, too.
   */
  template <int dim>
  struct LinearProblem
  {
    /** Number of unknowns of all ranks. Collective. */
    std::size_t n_unknowns() const;

    NodeExchange     nodes;
    BlockPattern     pattern;
    BlockMatrix<dim> matrix;

    /** Whether the values are symmetric; the pattern is. */
    bool symmetric = true;

    /** Whether a matrix, or one much like it, is solved with many times: in
     * linear and dynamic scenes. */
    bool serves_long = true;

    /** The same with moderate enforcement, if has_moderate. */
    BlockMatrix<dim> moderate;
    bool             has_moderate = false;

    /** Per node: whether a cell with boundary particles holds it. */
    std::vector<char> enforced;

    std::vector<Point<dim>> points; // of the nodes

    /** Lines of functions, one a direction, whose products the nodes are, and
     * the place of each node on them: what geometric multigrid needs. Both
     * empty without a lattice. */
    std::vector<SplineLine>           lines;
    std::vector<std::array<int, dim>> lattice;
  };

  /**
   * Solves the linear problems of a run: by a direct factorisation or
   * conjugate gradients with the band preconditioner, chosen by size and
   * dimension, and keeps either while it serves. What is not symmetric is
   * iterated on with incomplete factors or factorised. Factorised is what one
   * process has; on several, which then call everything together, problems must
   * be iterative().
   */
  template <int dim>
  class LinearSolver
  {
  public:
    LinearSolver(const LinearSolverParameters &parameters, Counters &counters);
    ~LinearSolver();

    /** Tells that the pattern (and with it points, lattice) changed. */
    void new_pattern(const LinearProblem<dim> &problem);

    /** Whether moderate is wanted for a problem of this size on @p lines. With
     * smooth functions, without a lattice, or with matrices that serve long
     * iterating pays later. */
    bool iterative(const std::size_t              n_unknowns,
                   const std::vector<SplineLine> &lines,
                   const bool                     serves_long) const;

    /** Tells that the matrix changed; a factor kept from before may go on
     * serving as preconditioner. */
    void new_matrix(const LinearProblem<dim> &problem);

    /**
     * x = A^-1 b, to the tolerance on the preconditioned residual, times
     * @p looser where b is the small rest of a larger right-hand side. If @p
     * further is not 0, x only improves the last solution for which it was: an
     * iteration then refers its residual to that of the other, with the
     * tolerance times @p further in place of @p looser; if nothing is left to
     * improve, x = 0. Throws StepFailed if the matrix is singular or the
     * iteration does not converge.
     */
    void solve(const LinearProblem<dim>  &problem,
               const std::vector<double> &b,
               std::vector<double>       &x,
               const double               looser  = 1.,
               const double               further = 0.);

    /**
     * The two ways to solve what is not symmetric, which solve() takes one
     * after the other; of several ranks, all take the first together and one
     * the second. Returns whether that has solved it: with incomplete factors
     * where a digit more or less does not count.
     */
    bool solve_incompletely(const LinearProblem<dim>  &problem,
                            const std::vector<double> &b,
                            std::vector<double>       &x,
                            const double               looser);
    void solve_by_pivots(const LinearProblem<dim>  &problem,
                         const std::vector<double> &b,
                         std::vector<double>       &x);

    /** "CHOLMOD (supernodal)" or "CG, band + geometric multigrid" ... */
    std::string description() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace Impoint

#endif
