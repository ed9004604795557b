#ifndef impoint_terms_body_force_h
#define impoint_terms_body_force_h

#include <impoint/base/expression.h>
#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace Impoint
{
  /** A body's load per mass. */
  template <int dim>
  struct BodyLoad
  {
    Expression<dim> per_mass; // [m/s2]
    bool of_start = false;    // of the place at the start of the run, not now
  };

  /** Forces of the bodies' loads per mass at a time on the active nodes: rho b
   * N_I of P Eq. 15. They do not depend on the step's displacements. @p masses:
   * of the nodes, if they are known: then a load that is the same everywhere
   * needs no look at the points. Collective. */
  template <int dim>
  LinearAlgebra::distributed::Vector<double> body_force(
    const MaterialPoints<dim>                        &points,
    const ActiveNodes<dim>                           &active,
    const std::vector<BodyLoad<dim>>                 &body_loads, // per body
    const double                                      at,
    const LinearAlgebra::distributed::Vector<double> *masses = nullptr);
} // namespace Impoint

#endif
