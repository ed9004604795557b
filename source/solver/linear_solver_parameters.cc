#include <impoint/base/parameter_file.h>
#include <impoint/solver/linear_solver.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace Impoint
{
  void LinearSolverParameters::declare(ParameterFile &file)
  {
    EntryHandler &prm = file.handler();
    prm.enter_subsection("Linear solver");
    prm.add_parameter("Kind",
                      kind,
                      "A direct factorisation, conjugate gradients with the "
                      "band preconditioner, or the choice by dimension and "
                      "number of unknowns. Not symmetric (friction) and not "
                      "direct: biconjugate gradients, or else a factorisation.",
                      Patterns::Selection("automatic|direct|iterative"));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Reduction of the preconditioned residual [-].",
                      Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "Of conjugate gradients; a solve that needs more fails "
                      "the step.",
                      Patterns::Integer(1));
    prm.add_parameter(
      "Sliver",
      sliver,
      "Nodes with a diagonal stiffness below this part of the "
      "median are solved for exactly [-]; with splines, whose outer "
      "functions are small by nature, below 1e4 times that.",
      Patterns::Double(0., 1.));
    prm.add_parameter("Renew iterations",
                      renew_iterations,
                      "A preconditioner made for an earlier matrix is kept "
                      "while it needs no more iterations than this.",
                      Patterns::Integer(0));
    prm.leave_subsection();
  }

  double LinearSolverParameters::loosened(const double looser) const
  {
    constexpr double loosest = 1e-2;
    return std::max(tolerance, std::min(loosest, looser * tolerance));
  }
} // namespace Impoint
