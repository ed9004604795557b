#ifndef impoint_boundary_forces_h
#define impoint_boundary_forces_h

#include <impoint/measurements/measurement.h>
#include <impoint/solver/nonlinear_system.h>

#include <vector>

namespace Impoint
{
  /**
   * This rank's parts of the forces and moments that conforming boundaries
   * exert in the step that @p system was solved for: at the deformed places
   * of the nodes they hold.
   */
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  conforming_forces(const NonlinearSystem<dim>                  &system,
                    const Enforcement::Conforming<dim>          &conforming,
                    const ActiveNodes<dim>                      &active,
                    const typename NonlinearSystem<dim>::Vector &u);

  /** The same of nonconforming boundaries, whose particles are brought up to
   * date, but for their places. */
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  nonconforming_forces(const NonlinearSystem<dim>                  &system,
                       typename NonlinearSystem<dim>::Methods      &methods,
                       const ActiveNodes<dim>                      &active,
                       const typename NonlinearSystem<dim>::Vector &u);
} // namespace Impoint

#endif
