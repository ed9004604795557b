#ifndef impoint_particles_smoothed_forces_h
#define impoint_particles_smoothed_forces_h

#include <impoint/particles/boundary_particles.h>

#include <vector>

namespace Impoint
{
  /**
   * Forces of a boundary's particles, smoothed (L Eqs. 36-39): added up at the
   * nodes, R_I = sum_b N_I(b) R_b, and from there shared among particles by
   * their part of the node's area, R_b = sum_I N_I(b) A_b / A_I R_I with A_I =
   * sum_b N_I(b) A_b. The sum stays the same; the moment only about. As they
   * are with quadratic elements, whose functions are not positive. Collective.
   */
  template <int dim>
  std::vector<Tensor<1, dim>>
  smoothed_forces(const BoundaryParticles<dim> &boundary,
                  const Basis<dim>             &basis);
} // namespace Impoint

#endif
