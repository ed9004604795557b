#ifndef impoint_particles_simplex_rules_h
#define impoint_particles_simplex_rules_h

#include <deal.II/base/quadrature.h>

#include <string>

namespace Impoint
{
  using namespace dealii;

  /** Whether a symmetric rule with positive weights and @p n_points is known
   * for triangles (@p dim = 2) or tetrahedra. */
  bool has_simplex_rule(const unsigned int dim, const unsigned int n_points);

  /** The numbers of points for which there is one, as "1, 3, ...". */
  std::string simplex_rule_sizes_text(const unsigned int dim);

  /** The rule with @p n_points, which has_simplex_rule(). */
  template <int dim>
  Quadrature<dim> simplex_rule(const unsigned int n_points);

  /** Largest n for which simplex_rule_of_order() has a rule. */
  unsigned int max_simplex_order(const unsigned int dim);

  /** A rule that is exact to degree 2 n - 1, as n Gauss points on a line. */
  template <int dim>
  Quadrature<dim> simplex_rule_of_order(const unsigned int n);
} // namespace Impoint

#endif
