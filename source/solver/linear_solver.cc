#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/band_preconditioner.h>
#include <impoint/solver/block_ilu.h>
#include <impoint/solver/direct_solver.h>
#include <impoint/solver/linear_solver.h>
#include <impoint/solver/lu_solver.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace Impoint
{
  namespace
  {
    /**
     * Unknowns from which 'automatic' iterates, on a lattice of these lines or
     * without one. For one solve with one matrix
     * (tests/benchmarks/linear_solvers.cc and iterations, CPU time of one core,
     * OpenBLAS) both cost the same at about 4e3 unknowns in 3D and below 3e3 in
     * 2D on a lattice of linear functions; of quadratic ones, at 1.5e4 in 3D;
     * of cubic ones beyond 1.1e4, where the factor is twice as fast; without a
     * lattice, from 6e3 to 2e4 in 3D and at 2e4 in 2D. A factor serves further
     * solves at a fifteenth to a quarter of an iteration's price and minds the
     * conditioning less, so 2D prefers it while it costs no more than a tenth
     * of a second, if it serves long. If every iteration of Newton's method
     * asks for a new one, iterating takes half of the time at 7e3 unknowns and
     * a third at 3e4. Several ranks iterate together from the same sizes.
     */
    template <int dim>
    std::size_t iterate_from(const std::vector<SplineLine> &lines,
                             const bool                     serves_long)
    {
      const int degree = lines.empty() ? 0 : lines[0].degree;
      if (dim == 2)
        return serves_long || degree != 1 ? 40000 : 5000;
      return degree == 1 ? 6000 : degree == 3 ? 60000 : 15000;
    }

    /** An old factor may iterate for this part of the time that a
     * factorisation takes. */
    constexpr double old_factor_share = 0.7;

    /** After an old factor has failed, that many matrices are factorised at
     * once before one is tried again; doubled by every further failure. */
    constexpr unsigned int longest_distrust = 8;
  } // namespace

  template <int dim>
  std::size_t LinearProblem<dim>::n_unknowns() const
  {
    return Utilities::MPI::sum(std::size_t(pattern.n_rows()) * dim,
                               nodes.communicator());
  }

  template <int dim>
  struct LinearSolver<dim>::Implementation
  {
    Implementation(const LinearSolverParameters &parameters, Counters &counters)
      : parameters(parameters)
      , counters(counters)
      , band(parameters.sliver)
    {}

    /** Makes the factor or the band preconditioner for this matrix. */
    void renew(const LinearProblem<dim> &problem);

    /** Solves with what was made for an earlier matrix, if that pays. */
    bool try_old(const LinearProblem<dim>  &problem,
                 const std::vector<double> &b,
                 const double               tolerance,
                 std::vector<double>       &x);

    IterationResult iterate(const LinearProblem<dim>  &problem,
                            const std::vector<double> &b,
                            IterationControl           control,
                            std::vector<double>       &x);

    unsigned int most_iterations_of_old() const;

    /** Factorises from now on, if the problem is of a size for it. */
    bool gives_up_iterating(const LinearProblem<dim> &problem);

    /** Solves a matrix that is not symmetric without a factor, if that pays. */
    bool try_incomplete(const LinearProblem<dim>  &problem,
                        const std::vector<double> &b,
                        const double               tolerance,
                        std::vector<double>       &x);

    /** Notes whether iterating served: if not, the next matrices are
     * factorised at once. */
    bool learn(const bool served);

    const LinearSolverParameters &parameters;
    Counters                     &counters;

    bool                    iterative = false, symmetric = true;
    DirectSolver<dim>       factor;
    LuSolver<dim>           lu;
    bool                    lu_knows_pattern = false;
    BlockIlu<dim>           incomplete;
    bool                    incomplete_is_current = false;
    BandPreconditioner<dim> band;

    bool         exists    = false; // factor or band, for some matrix
    bool         current   = false; // for this very matrix
    bool         proved    = false; // current, and one solve was enough
    bool         improves  = false; // the solve at work: the last solution
    double       reference = 0;     // preconditioned residual of that
    unsigned int iterations_when_new = 0;

    // old factors that did not serve: how many matrices in a row are to be
    // factorised at once, and how many of these are left
    unsigned int distrust = 0, distrusted = 0;
  };

  template <int dim>
  void
  LinearSolver<dim>::Implementation::renew(const LinearProblem<dim> &problem)
  {
    exists = current = proved = false;
    iterations_when_new       = 0;
    ++counters.factorisations;
    const std::optional<unsigned int> failed =
      iterative ? band.renew(problem) : factor.factorize(problem.matrix);
    if (failed)
      on_all_ranks(problem.nodes.communicator(), [&]() {
        if (*failed >= problem.pattern.n_rows())
          return;
        std::ostringstream message;
        message << "The linear system is not positive definite: no positive "
                   "pivot at the node at ("
                << problem.points[*failed]
                << "). A body without sufficient supports, a material that "
                   "softens, cells finer than the points are apart, or too "
                   "large a step bring this about; so do cells of splines that "
                   "a surface cuts ('Ghost penalty' in section "
                   "'Grid') and 'nitsche' (see 'Nitsche form').";
        throw StepFailed(message.str());
      });
    exists = current = true;
  }

  template <int dim>
  unsigned int LinearSolver<dim>::Implementation::most_iterations_of_old() const
  {
    if (iterative)
      return std::max(parameters.renew_iterations,
                      iterations_when_new + iterations_when_new / 2 + 5);
    return static_cast<unsigned int>(old_factor_share *
                                     factor.solves_per_factorisation());
  }

  template <int dim>
  IterationResult
  LinearSolver<dim>::Implementation::iterate(const LinearProblem<dim>  &problem,
                                             const std::vector<double> &b,
                                             IterationControl           control,
                                             std::vector<double>       &x)
  {
    control.reference = improves ? reference : 0.;
    const Preconditioner &preconditioner =
      iterative ? static_cast<const Preconditioner &>(band) : factor;
    const IterationResult result = conjugate_gradients(
      problem.matrix, problem.nodes, preconditioner, b, control, x);
    reference = improves ? reference : result.start;
    counters.linear_iterations += result.iterations;
    // the first iteration with its own factor is the direct solve
    if (!iterative && current && result.iterations > 0)
      --counters.linear_iterations;
    return result;
  }

  template <int dim>
  bool
  LinearSolver<dim>::Implementation::try_old(const LinearProblem<dim>  &problem,
                                             const std::vector<double> &b,
                                             const double         tolerance,
                                             std::vector<double> &x)
  {
    if (distrusted > 0)
      {
        --distrusted;
        return false;
      }
    IterationControl control;
    control.tolerance      = tolerance;
    control.max_iterations = most_iterations_of_old();
    control.give_up_early  = true;
    return learn(iterate(problem, b, control, x).converged);
  }

  template <int dim>
  bool LinearSolver<dim>::Implementation::learn(const bool served)
  {
    distrust   = served ? 0 : std::min(longest_distrust, 2 * distrust + 1);
    distrusted = distrust;
    return served;
  }

  template <int dim>
  bool LinearSolver<dim>::Implementation::gives_up_iterating(
    const LinearProblem<dim> &problem)
  {
    if (!iterative || parameters.kind != "automatic" ||
        !problem.nodes.alone() ||
        problem.n_unknowns() >= iterate_from<dim>(problem.lines, true))
      return false;
    iterative = false;
    factor.new_pattern(problem.pattern);
    renew(problem);
    return true;
  }

  template <int dim>
  bool LinearSolver<dim>::Implementation::try_incomplete(
    const LinearProblem<dim>  &problem,
    const std::vector<double> &b,
    const double               tolerance,
    std::vector<double>       &x)
  {
    // All digits, of one solve without another: a factor has more of them.
    if (parameters.kind == "direct" || tolerance <= parameters.tolerance)
      return false;
    if (!incomplete_is_current)
      {
        if (distrusted > 0)
          {
            --distrusted;
            return false;
          }
        if (!Utilities::MPI::min(int(incomplete.factorize(problem.matrix)),
                                 problem.nodes.communicator()))
          return learn(false);
        incomplete_is_current = true;
      }
    const auto result =
      incomplete.solve(problem.matrix, problem.nodes, b, tolerance, x);
    counters.linear_iterations += result.iterations;
    return learn(result.converged);
  }

  template <int dim>
  LinearSolver<dim>::LinearSolver(const LinearSolverParameters &parameters,
                                  Counters                     &counters)
    : implementation(std::make_unique<Implementation>(parameters, counters))
  {}

  template <int dim>
  LinearSolver<dim>::~LinearSolver() = default;

  template <int dim>
  void LinearSolver<dim>::new_pattern(const LinearProblem<dim> &problem)
  {
    Implementation &data = *implementation;
    data.exists = data.current = data.proved = false;
    data.lu_knows_pattern = data.incomplete_is_current = false;
    data.distrust = data.distrusted = 0;
    data.symmetric                  = problem.symmetric;
    data.iterative =
      problem.symmetric &&
      iterative(problem.n_unknowns(), problem.lines, problem.serves_long);
    Assert(data.iterative || !data.symmetric || problem.nodes.alone(),
           ExcInternalError());
    if (data.iterative)
      data.band.new_pattern();
    else if (data.symmetric)
      data.factor.new_pattern(problem.pattern);
  }

  template <int dim>
  bool LinearSolver<dim>::iterative(const std::size_t              n_unknowns,
                                    const std::vector<SplineLine> &lines,
                                    const bool serves_long) const
  {
    const std::string &kind = implementation->parameters.kind;
    return kind == "iterative" ||
           (kind == "automatic" &&
            n_unknowns >= iterate_from<dim>(lines, serves_long));
  }

  template <int dim>
  void LinearSolver<dim>::new_matrix(const LinearProblem<dim> &problem)
  {
    Implementation &data = *implementation;
    data.current = data.proved = data.incomplete_is_current = false;
    data.band.outdate();
    // a stiff enforcement outside of the old band would not be bounded
    if (data.iterative && !data.band.serves(problem))
      data.exists = false;
  }

  template <int dim>
  bool LinearSolver<dim>::solve_incompletely(const LinearProblem<dim>  &problem,
                                             const std::vector<double> &b,
                                             std::vector<double>       &x,
                                             const double               looser)
  {
    return implementation->try_incomplete(
      problem, b, implementation->parameters.loosened(looser), x);
  }

  template <int dim>
  void LinearSolver<dim>::solve_by_pivots(const LinearProblem<dim>  &problem,
                                          const std::vector<double> &b,
                                          std::vector<double>       &x)
  {
    Implementation &data = *implementation;
    if (!data.current)
      {
        ++data.counters.factorisations;
        if (!data.lu_knows_pattern)
          data.lu.new_pattern(problem.pattern);
        data.lu_knows_pattern = true;
        if (!data.lu.factorize(problem.matrix))
          throw StepFailed("The linear system is singular: a body without "
                           "sufficient supports, or a material that has lost "
                           "its stiffness");
        data.current = true;
      }
    data.lu.vmult(b, x);
  }

  template <int dim>
  void LinearSolver<dim>::solve(const LinearProblem<dim>  &problem,
                                const std::vector<double> &b,
                                std::vector<double>       &x,
                                const double               looser,
                                const double               further)
  {
    Implementation &data = *implementation;
    data.improves        = further > 0 && data.symmetric && data.iterative;
    const double tolerance =
      data.parameters.loosened(data.improves ? further : looser);
    Assert(b.size() == problem.pattern.n_rows() * dim,
           ExcDimensionMismatch(b.size(), problem.pattern.n_rows() * dim));
    if (!data.symmetric)
      {
        if (data.current || !data.try_incomplete(problem, b, tolerance, x))
          solve_by_pivots(problem, b, x);
        return;
      }
    if (data.proved)
      {
        data.factor.vmult(b, x);
        return;
      }
    if (data.exists && !data.current && data.try_old(problem, b, tolerance, x))
      return;
    if (!data.current)
      data.renew(problem);

    IterationControl control;
    control.tolerance      = tolerance;
    control.max_iterations = data.parameters.max_iterations;
    IterationResult result = data.iterate(problem, b, control, x);
    if (!result.converged && data.gives_up_iterating(problem))
      result = data.iterate(problem, b, control, x);
    data.iterations_when_new =
      std::max(data.iterations_when_new, result.iterations);
    if (!result.converged)
      {
        std::ostringstream message;
        message << "The linear system was not solved in " << result.iterations
                << " iterations of conjugate gradients: the preconditioned "
                   "residual fell by "
                << result.reduction << " only, not by " << control.tolerance
                << ". The matrix is singular (a body without sufficient "
                   "supports) or badly conditioned; 'Kind = direct' in section "
                   "'Linear solver' copes with the latter.";
        throw StepFailed(message.str());
      }
    data.proved = !data.iterative && result.iterations == 1;
  }

  template <int dim>
  std::string LinearSolver<dim>::description() const
  {
    const Implementation &data = *implementation;
    if (!data.symmetric)
      return data.parameters.kind == "direct" ?
               "UMFPACK" :
               "biconjugate gradients, UMFPACK";
    if (!data.iterative)
      return data.factor.supernodal() ? "CHOLMOD (supernodal)" :
                                        "CHOLMOD (simplicial)";
    return "CG, " + data.band.description();
  }

  template struct LinearProblem<2>;
  template struct LinearProblem<3>;
  template class LinearSolver<2>;
  template class LinearSolver<3>;
} // namespace Impoint
