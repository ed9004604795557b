#ifndef impoint_solver_rigid_modes_h
#define impoint_solver_rigid_modes_h

#include <impoint/solver/linear_solver.h>

namespace Impoint
{
  /**
   * Throws RunFailed, naming the motion, if a connected part of @p problem can
   * move as a rigid body without any stiffness: statics has no answer then.
   * Collective on the ranks of the problem.
   */
  template <int dim>
  void check_rigid_modes(const LinearProblem<dim> &problem);
} // namespace Impoint

#endif
