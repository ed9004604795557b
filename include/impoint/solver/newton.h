#ifndef impoint_solver_newton_h
#define impoint_solver_newton_h

#include <impoint/solver/nonlinear_system.h>

#include <string>
#include <vector>

namespace Impoint
{
  class ParameterFile;

  /** Settings of the Newton iteration within a step. */
  struct NewtonParameters
  {
    void declare(ParameterFile &file);

    unsigned int max_iterations      = 25;
    double       tolerance           = 1e-10;
    double       increment_tolerance = 1e-5;
    bool         line_search         = true;
  };

  /**
   * Newton's method for the displacements of a step. Converged is what has a
   * small residual, relative to the forces that balance in it, after a small
   * last correction, relative to the displacements.
   */
  template <int dim>
  class Newton
  {
  public:
    Newton(const NewtonParameters &parameters,
           NonlinearSystem<dim>   &system,
           Counters               &counters);

    /** Finds the displacements of the step that the system was prepared for.
     * Throws StepFailed. Collective. */
    void solve(typename NonlinearSystem<dim>::Vector &u);

    /** Relative residuals of the last step: before each iteration, and last. */
    const std::vector<double> &residuals() const
    {
      return history;
    }

    unsigned int iterations() const
    {
      return history.size() - 1;
    }

  private:
    using Vector = typename NonlinearSystem<dim>::Vector;

    /** Moves u along delta as far as the residual allows; returns the new
     * relative residual. */
    double advance(const Vector &delta, const bool tangent_wanted, Vector &u);

    void finish_linear_step(Vector &delta, Vector &u);

    bool has_converged(const Vector &delta, const Vector &u);
    bool expects_convergence() const;
    bool stalls() const;

    const NewtonParameters parameters;
    NonlinearSystem<dim>  &system;
    Counters              &counters;
    std::vector<double>    history;
    std::vector<double>    norms;                  // [N], of the same residuals
    bool                   tangent_is_new = false; // with the last residual
    unsigned int           n_balanced     = 0;     // iterates in a row
  };
} // namespace Impoint

#endif
