#ifndef impoint_grid_linear_functions_h
#define impoint_grid_linear_functions_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace Impoint
{
  using namespace dealii;

  /** Values and reference gradients of the linear functions of a simplex or
   * the multilinear ones of a hypercube, in deal.II's order of vertices. */
  template <int dim, bool simplex>
  inline void
  linear_functions(const Point<dim> &xi, double *values, double *gradients)
  {
    if constexpr (simplex)
      {
        values[0] = 1.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            values[0] -= xi[d];
            values[d + 1] = xi[d];
            gradients[d]  = -1.;
            for (unsigned int e = 0; e < dim; ++e)
              gradients[(d + 1) * dim + e] = (d == e);
          }
      }
    else
      for (unsigned int v = 0; v < (1 << dim); ++v)
        {
          double factor[dim], slope[dim];
          for (unsigned int d = 0; d < dim; ++d)
            {
              const bool upper = (v >> d) & 1;
              factor[d]        = upper ? xi[d] : 1. - xi[d];
              slope[d]         = upper ? 1. : -1.;
            }
          values[v] = factor[0] * factor[1] * (dim == 3 ? factor[dim - 1] : 1.);
          for (unsigned int d = 0; d < dim; ++d)
            {
              double product = slope[d];
              for (unsigned int e = 0; e < dim; ++e)
                if (e != d)
                  product *= factor[e];
              gradients[v * dim + d] = product;
            }
        }
  }

  /** Supports (see Basis::evaluate()) of places in an affine cell with the
   * given inverse of the Jacobian, one after the other. */
  template <int dim, bool simplex>
  void linear_supports(const Tensor<2, dim>              &inverse,
                       const ArrayView<const Point<dim>> &xi,
                       double                            *support)
  {
    constexpr unsigned int n = simplex ? dim + 1 : 1 << dim;
    double                 reference[n * dim];
    for (const Point<dim> &place : xi)
      {
        linear_functions<dim, simplex>(place, support, reference);
        double *gradients = support + n;
        for (unsigned int v = 0; v < n; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            {
              double sum = 0;
              for (unsigned int e = 0; e < dim; ++e)
                sum += inverse[e][d] * reference[v * dim + e];
              gradients[v * dim + d] = sum;
            }
        support += n * (dim + 1);
      }
  }
} // namespace Impoint

#endif
