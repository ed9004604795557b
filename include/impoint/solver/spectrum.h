#ifndef impoint_solver_spectrum_h
#define impoint_solver_spectrum_h

#include <deal.II/lac/la_parallel_vector.h>

#include <functional>

namespace Impoint
{
  using namespace dealii;

  /**
   * Largest eigenvalue of a symmetric operator, @p apply(x, y): y = A x, to
   * about three digits: the Lanczos process from @p start, which must not be
   * orthogonal to its eigenvector. Collective.
   */
  double largest_eigenvalue(
    const std::function<void(const LinearAlgebra::distributed::Vector<double> &,
                             LinearAlgebra::distributed::Vector<double> &)>
                                                     &apply,
    const LinearAlgebra::distributed::Vector<double> &start);
} // namespace Impoint

#endif
