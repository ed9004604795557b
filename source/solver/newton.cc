#include <impoint/base/exceptions.h>
#include <impoint/base/parameter_file.h>
#include <impoint/solver/newton.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Impoint
{
  void NewtonParameters::declare(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.enter_subsection("Newton");
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "A step that needs more is halved and repeated.",
                      Patterns::Integer(1));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Residual, relative to the forces that balance in it.",
                      Patterns::Double(1e-15, 1e-2));
    prm.add_parameter("Increment tolerance",
                      increment_tolerance,
                      "Last correction, relative to the step's displacements.",
                      Patterns::Double(1e-15, 1));
    prm.add_parameter("Line search",
                      line_search,
                      "Shorten corrections that make the residual larger.",
                      Patterns::Bool());
    prm.leave_subsection();
  }



  template <int dim>
  Newton<dim>::Newton(const NewtonParameters &parameters,
                      NonlinearSystem<dim>   &system,
                      Counters               &counters)
    : parameters(parameters)
    , system(system)
    , counters(counters)
  {}



  template <int dim>
  void Newton<dim>::solve(Vector &u)
  {
    constexpr unsigned int patience = 5; // contact finds itself in the first
    Vector                 delta;
    history.assign(1, system.evaluate(u, true));
    norms.assign(1, system.residual_norm());
    n_balanced  = 0;
    bool frozen = false;
    for (unsigned int iteration = 0; iteration < parameters.max_iterations;
         ++iteration)
      {
        ++counters.newton_iterations;
        if (iteration == std::max(parameters.max_iterations / 2, patience))
          system.freeze(frozen = true); // ends a cycle of what touches
        system.correct(iteration == 0, u, delta);
        if (system.is_linear())
          return finish_linear_step(delta, u);
        history.push_back(advance(delta, !expects_convergence(), u));
        norms.push_back(system.residual_norm());
        if (has_converged(delta, u))
          {
            if (!frozen)
              return;
            system.freeze(frozen = false);
            history.back() = system.evaluate(u, true);
            norms.back()   = system.residual_norm();
            if (history.back() <= parameters.tolerance &&
                system.contact_settled())
              return;
          }
        else if (!tangent_is_new)
          system.evaluate(u, true);
      }
    std::ostringstream text;
    text << "Newton's iteration left a relative residual of " << history.back()
         << " after " << parameters.max_iterations << " iterations";
    throw StepFailed(text.str());
  }



  /** Where contact opens and closes at next to no force, displacements of
   * nodes that hold next to no material jump with it for ever: there, forces
   * that stay in balance are enough. So they are where displacements are
   * round-off of those of all steps before, as in a step without new loads. */
  template <int dim>
  bool Newton<dim>::has_converged(const Vector &delta, const Vector &u)
  {
    constexpr unsigned int enough    = 3;
    constexpr double       round_off = 1e6; // of an accurate displacement
    const double           residual  = history.back();
    if (!system.contact_settled())
      return false;
    n_balanced = residual <= parameters.tolerance ? n_balanced + 1 : 0;
    if (n_balanced >= enough &&
        (system.has_kinks() ||
         delta.linfty_norm() <= round_off * system.smallest_displacement()))
      return true;
    return delta.linfty_norm() <=
             std::max(parameters.increment_tolerance * u.linfty_norm(),
                      system.smallest_displacement()) &&
           (residual <= parameters.tolerance ||
            residual <= system.round_off(u));
  }



  /** One correction solves a linear step. A second one with the same matrix
   * brings back the digits that a stiff boundary took from the material's, or
   * what the solver left. */
  template <int dim>
  void Newton<dim>::finish_linear_step(Vector &delta, Vector &u)
  {
    // Another solve for a residual that may be round-off has to pay.
    constexpr double worth = 100; // tolerances
    u += delta;
    u.update_ghost_values();
    const double round_off = system.round_off(u);
    double       left      = system.linear_residual(delta);
    if (system.is_stiff() ||
        left > std::max(parameters.tolerance,
                        std::min(worth * parameters.tolerance, round_off)))
      {
        history.push_back(system.evaluate(u, false));
        // the solve before took the residual from about one to this
        const double enough = 0.1 * parameters.tolerance / left;
        system.correct(false,
                       u,
                       delta,
                       system.is_stiff() ? 1. : std::max(1., enough / left));
        u += delta;
        u.update_ghost_values();
        left = system.linear_residual(delta);
      }
    // Reactions of held nodes are what the residual leaves there; and only the
    // residual shows what sums of stiff boundaries' forces lose.
    history.push_back(system.has_held_nodes() || system.may_lose_digits(u) ?
                        system.evaluate(u, false) :
                        left);
    if (!std::isfinite(history.back()))
      throw StepFailed("The linear system has no solution in finite numbers");
    if (left > std::max(parameters.tolerance, round_off))
      {
        std::ostringstream text;
        text << "The linear system's solution leaves a relative residual of "
             << left;
        throw StepFailed(text.str());
      }
  }



  /** Whether the next residual will be small enough, if it goes on falling
   * quadratically: then no tangent is assembled with it. */
  template <int dim>
  bool Newton<dim>::expects_convergence() const
  {
    const unsigned int n = history.size();
    return n >= 2 && history[n - 1] < 1e-2 * history[n - 2] &&
           history[n - 1] * history[n - 1] / history[n - 2] <
             parameters.tolerance;
  }



  /** Where a point yields and yields not in turn, full steps lead from one side
   * of the kink to the other and back, for ever. Steps that must make the
   * residual smaller end that. */
  template <int dim>
  bool Newton<dim>::stalls() const
  {
    const unsigned int n = norms.size();
    return n >= 3 && norms[n - 1] > 0.5 * norms[n - 3];
  }



  template <int dim>
  double Newton<dim>::advance(const Vector &delta,
                              const bool    tangent_wanted,
                              Vector       &u)
  {
    constexpr double       worst_growth  = 2.;
    constexpr double       least_descent = 0.1;
    constexpr unsigned int max_cuts      = 8;
    if (!std::isfinite(delta.l2_norm()))
      throw StepFailed("the linear solver's correction is not a number");
    const Vector start(u);
    const bool   must_descend = stalls();
    double       part         = 1.;
    for (unsigned int cut = 0;; ++cut, part *= 0.5)
      {
        u = start;
        u.add(part, delta);
        u.update_ghost_values();
        // A cut first correction would leave a part of what conforming
        // boundaries prescribe: the step is halved instead.
        const bool last = !parameters.line_search || cut == max_cuts ||
                          system.brings_prescribed();
        try
          {
            system.cut_multipliers(part);
            tangent_is_new        = tangent_wanted && cut == 0;
            const double residual = system.evaluate(u, tangent_is_new);
            // The first correction brings prescribed displacements in: there
            // is nothing to compare its residual with. Nor is there where other
            // constraints act: then the residual may well grow on the way.
            if (last || history.size() == 1 ||
                std::isfinite(residual) == false || system.contact_changed() ||
                residual <= parameters.tolerance ||
                system.residual_norm() <=
                  (must_descend ? 1. - least_descent * part : worst_growth) *
                    norms.back())
              {
                if (!std::isfinite(residual))
                  throw StepFailed("the residual is not a number");
                return residual;
              }
          }
        catch (const StepFailed &)
          {
            if (last)
              throw;
          }
      }
  }

  template class Newton<2>;
  template class Newton<3>;
} // namespace Impoint
