#ifndef impoint_terms_body_force_h
#define impoint_terms_body_force_h

#include <impoint/base/expression.h>
#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace Impoint
{
  /** Forces of the bodies' loads per mass at a time on the active nodes: rho b
   * N_I of P Eq. 15. They do not depend on the step's displacements.
   * Collective. */
  template <int dim>
  LinearAlgebra::distributed::Vector<double>
  body_force(const MaterialPoints<dim>          &points,
             const ActiveNodes<dim>             &active,
             const std::vector<Expression<dim>> &body_forces, // per body
             const double                        at);
} // namespace Impoint

#endif
