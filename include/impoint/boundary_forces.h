#ifndef impoint_boundary_forces_h
#define impoint_boundary_forces_h

#include <impoint/measurements/measurement.h>
#include <impoint/solver/nonlinear_system.h>

#include <vector>

namespace Impoint
{
  /**
   * This rank's parts of the forces and moments that conforming boundaries
   * exert in the step that @p system was solved for: at the places that the
   * displacements @p u from those of the grid bring the nodes they hold to.
   */
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  conforming_forces(const NonlinearSystem<dim>                  &system,
                    const Enforcement::Conforming<dim>          &conforming,
                    const ActiveNodes<dim>                      &active,
                    const typename NonlinearSystem<dim>::Vector &u);

  /** Brings the particles of nonconforming boundaries up to date after a step
   * with the displacements @p u, but for their places. Collective. */
  template <int dim>
  void end_step_of_boundaries(const NonlinearSystem<dim>             &system,
                              typename NonlinearSystem<dim>::Methods &methods,
                              const ActiveNodes<dim>                 &active,
                              const typename NonlinearSystem<dim>::Vector &u);

  /** The same of nonconforming boundaries, after end_step_of_boundaries(). */
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  nonconforming_forces(const NonlinearSystem<dim>                   &system,
                       const typename NonlinearSystem<dim>::Methods &methods,
                       const ActiveNodes<dim>                       &active,
                       const typename NonlinearSystem<dim>::Vector  &u);

  /** What nonconforming boundaries add to the linear balance before the first
   * step, whose solution is @p u: forces without moments. */
  template <int dim>
  std::vector<Measurements::BoundaryForce<dim>>
  balanced_forces(const NonlinearSystem<dim>                   &system,
                  const typename NonlinearSystem<dim>::Methods &methods,
                  const ActiveNodes<dim>                       &active,
                  const typename NonlinearSystem<dim>::Vector  &u);
} // namespace Impoint

#endif
