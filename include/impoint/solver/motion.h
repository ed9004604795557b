#ifndef impoint_solver_motion_h
#define impoint_solver_motion_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>
#include <impoint/solver/inertia.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <vector>

namespace Impoint
{
  // From the nodes back to the material points: P Eqs. 22-25. Vectors are on
  // the active nodes, ghosts up to date; the points are still where they were
  // when their supports were evaluated.

  /** Where the points will be after a step with displacements @p u. */
  template <int dim>
  void new_places(const MaterialPoints<dim>                        &points,
                  const ActiveNodes<dim>                           &active,
                  const LinearAlgebra::distributed::Vector<double> &u,
                  std::vector<Point<dim>>                          &places);

  /** Gives the points the accelerations of the nodes. */
  template <int dim>
  void set_accelerations(
    const ActiveNodes<dim>                           &active,
    const LinearAlgebra::distributed::Vector<double> &accelerations,
    MaterialPoints<dim>                              &points);

  /** Places, displacements, deformation gradients, stresses and histories of
   * the points after the step, and their velocities unless @p inertia is
   * null. @p end_states, if they are kept, are those at @p u. @p updated, if
   * any, is called for each cell's points when they are done. */
  template <int dim>
  void update_points(
    const ActiveNodes<dim>                           &active,
    const LinearAlgebra::distributed::Vector<double> &u,
    const Inertia<dim>                               *inertia,
    const EndStates<dim>                             &end_states,
    MaterialPoints<dim>                              &points,
    const std::function<void(const typename PointCloud<dim>::Range &)>
      &updated = {});
} // namespace Impoint

#endif
