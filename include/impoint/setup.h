#ifndef impoint_setup_h
#define impoint_setup_h

#include <impoint/scene.h>
#include <impoint/solver/nonlinear_system.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** The material points of all bodies with their initial state. Collective;
   * throws InputError. */
  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> place_bodies(const ParameterFile &file,
                                                    const Scene<dim>    &scene,
                                                    const Basis<dim>    &basis);

  /** The nonconforming boundaries, in the order of the scene. Collective;
   * throws InputError. */
  template <int dim>
  typename NonlinearSystem<dim>::Methods
  place_boundaries(const ParameterFile &file,
                   const Scene<dim>    &scene,
                   const Basis<dim>    &basis);

  /**
   * Whether a boundary's normals point out of the material: throws InputError
   * if they do not on more than half of its area within 2 h of material.
   * Returns false if no material is near, so that nobody can say. Collective.
   */
  template <int dim>
  bool check_normals(const ParameterFile          &file,
                     const BoundaryParameters     &parameters,
                     const BoundaryParticles<dim> &boundary,
                     const MaterialPoints<dim>    &points,
                     const BackgroundGrid<dim>    &grid);
} // namespace Impoint

#endif
