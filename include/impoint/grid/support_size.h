#ifndef impoint_grid_support_size_h
#define impoint_grid_support_size_h

#include <type_traits>

namespace Impoint
{
  /** Nodes of the largest support: of cubic splines in 3D. */
  constexpr int largest_support = 64;

  /** Size of an array over the nodes of a support (see with_support_size()). */
  template <int n_static>
  constexpr int array_size = n_static > 0 ? n_static : largest_support;

  /**
   * Calls f with the number of nodes @p n of a support as a compile-time
   * constant where it is that of linear functions or of quadratic ones on
   * hypercubes (splines, too), and with -1 otherwise: the compiler unrolls the
   * loops over the nodes.
   */
  template <int dim, typename Function>
  void with_support_size(const unsigned int n, const Function &f)
  {
    switch (n)
      {
        case dim + 1:
          return f(std::integral_constant<int, dim + 1>());
        case (1 << dim):
          return f(std::integral_constant<int, (1 << dim)>());
        case (dim == 2 ? 9 : 27):
          return f(std::integral_constant<int, dim == 2 ? 9 : 27>());
        default:
          return f(std::integral_constant<int, -1>());
      }
  }
} // namespace Impoint

#endif
