#ifndef impoint_solver_nodal_mass_h
#define impoint_solver_nodal_mass_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /**
   * Solves M x = b with the consistent mass M_IJ = sum_p m_p N_I N_J of the
   * active nodes: the velocities whose momenta are @p momenta, which they
   * replace. What next to no mass sees of them, and there is much of it where
   * cells have few points, stays as @p first_guess says. Collective.
   */
  template <int dim>
  void divide_by_consistent_mass(
    const ActiveNodes<dim>                           &active,
    const MaterialPoints<dim>                        &points,
    const LinearAlgebra::distributed::Vector<double> &first_guess,
    LinearAlgebra::distributed::Vector<double>       &momenta);
} // namespace Impoint

#endif
