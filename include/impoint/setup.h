#ifndef impoint_setup_h
#define impoint_setup_h

#include <impoint/scene.h>
#include <impoint/solver/nonlinear_system.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** The container of the scene's material points, still empty. Throws
   * InputError. */
  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> without_points(const ParameterFile &file,
                                                      const Scene<dim> &scene,
                                                      const Basis<dim> &basis);

  /** The material points of all bodies with their initial state. Collective;
   * throws InputError. */
  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> place_bodies(const ParameterFile &file,
                                                    const Scene<dim>    &scene,
                                                    const Basis<dim>    &basis);

  /** The nonconforming boundaries, in the order of the scene, with or without
   * their particles. Collective; throws InputError. */
  template <int dim>
  typename NonlinearSystem<dim>::Methods
  place_boundaries(const ParameterFile       &file,
                   const Scene<dim>          &scene,
                   const Basis<dim>          &basis,
                   const MaterialPoints<dim> &points,
                   const bool                 with_particles = true);
} // namespace Impoint

#endif
