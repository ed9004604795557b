#ifndef impoint_base_tensor_functions_h
#define impoint_base_tensor_functions_h

#include <impoint/base/voigt.h>

#include <deal.II/base/tensor.h>

#include <cmath>

namespace Impoint
{
  using namespace dealii;

  /** Below this the two functions that follow are series to round-off, in half
   * of the library's time: stiff materials ask for nothing else. */
  constexpr double short_series = 0.01;

  /** ln(1 + x) */
  inline double log_one_plus(const double x)
  {
    if (std::abs(x) > short_series)
      return std::log1p(x);
    // in pairs of terms, which do not wait for each other
    const double x2 = x * x;
    return x - x2 * ((1. / 2 - x * (1. / 3)) +
                     x2 * ((1. / 4 - x * (1. / 5)) +
                           x2 * ((1. / 6 - x * (1. / 7)) + x2 * (1. / 8))));
  }

  /** exp(x) - 1 */
  inline double exp_minus_one(const double x)
  {
    if (std::abs(x) > short_series)
      return std::expm1(x);
    const double x2 = x * x;
    return x + x2 * ((1. / 2 + x * (1. / 6)) +
                     x2 * ((1. / 24 + x * (1. / 120)) +
                           x2 * (1. / 720 + x * (1. / 5040))));
  }

  /** ln(1 + x) / x, to round-off everywhere. */
  inline double log1p_quotient(const double x)
  {
    return x == 0 ? 1 : log_one_plus(x) / x;
  }

  /** H = F - 1, exact for F near 1: what keeps small strains from drowning in
   * the round-off of quantities of order one. */
  template <int dim>
  inline Tensor<2, dim> displacement_gradient(const Tensor<2, dim> &F)
  {
    Tensor<2, dim> H = F;
    for (int i = 0; i < dim; ++i)
      H[i][i] -= 1;
    return H;
  }

  /** Throws StepFailed that names @p J, the determinant of a point's F. */
  [[noreturn]] void throw_not_positive(const double J);

  /** J - 1 = det(1 + H) - 1. Throws StepFailed unless J > 0. */
  template <int dim>
  inline double volume_change(const Tensor<2, dim> &H)
  {
    double change = trace(H) + determinant(H);
    if constexpr (dim == 3)
      change += H[0][0] * H[1][1] - H[0][1] * H[1][0] + //
                H[0][0] * H[2][2] - H[0][2] * H[2][0] + //
                H[1][1] * H[2][2] - H[1][2] * H[2][1];
    if (!(change > -1)) // also for NaN
      throw_not_positive(1 + change);
    return change;
  }

  /** b - 1 = F F^T - 1 = H + H^T + H H^T, tensor components. */
  template <int dim>
  inline VoigtVector<dim> left_strain(const Tensor<2, dim> &H)
  {
    VoigtVector<dim> strain;
    for (int k = 0; k < Voigt<dim>::n; ++k)
      {
        const int i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
        strain[k] = H[i][j] + H[j][i];
        for (int l = 0; l < dim; ++l)
          strain[k] += H[i][l] * H[j][l];
      }
    return strain;
  }

  /** sym @p gradient with engineering shears. */
  template <int dim>
  inline VoigtVector<dim> engineering_strain(const Tensor<2, dim> &gradient)
  {
    VoigtVector<dim> strain;
    for (int k = 0; k < Voigt<dim>::n; ++k)
      {
        const int i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
        strain[k] = i == j ? gradient[i][i] : gradient[i][j] + gradient[j][i];
      }
    return strain;
  }

  /** The symmetric tensor of @p components (not engineering shears). */
  template <int dim>
  inline Tensor<2, dim> to_tensor(const VoigtVector<dim> &components)
  {
    Tensor<2, dim> tensor;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        tensor[i][j] = components[Voigt<dim>::position(i, j)];
    return tensor;
  }

  /** Sum of the normal components present: in plane strain without zz. */
  template <int dim>
  inline double voigt_trace(const VoigtVector<dim> &a)
  {
    double sum = 0;
    for (int i = 0; i < dim; ++i)
      sum += a[i];
    return sum;
  }

  /** a : a of a symmetric tensor given by tensor components. */
  template <int dim>
  inline double voigt_square(const VoigtVector<dim> &a)
  {
    double sum = 0;
    for (int k = 0; k < Voigt<dim>::n; ++k)
      sum += (k < dim ? 1. : 2.) * a[k] * a[k];
    return sum;
  }

  /** Principal values of a symmetric tensor, in no order, and the directions as
   * the rows of @p directions. */
  template <int dim>
  struct Spectrum
  {
    std::array<double, dim> values;
    Tensor<2, dim>          directions;
  };

  /**
   * By Jacobi's rotations: to round-off of the largest value whatever the
   * distance of the values, with directions orthogonal to round-off.
   */
  template <int dim>
  Spectrum<dim> spectrum(const VoigtVector<dim> &symmetric);

  /** sum_a values_a n_a x n_a with the rows n_a of @p directions. */
  template <int dim>
  VoigtVector<dim> from_principal(const std::array<double, dim> &values,
                                  const Tensor<2, dim>          &directions);

  /**
   * A fourth-order tensor known in a principal frame (rows of @p directions),
   * in the fixed frame: @p normal holds its components aabb (need not be
   * symmetric), @p shear its components abab = abba in the order of Voigt.
   */
  template <int dim>
  VoigtMatrix<dim>
  from_principal(const std::array<std::array<double, dim>, dim> &normal,
                 const std::array<double, Voigt<dim>::n - dim>  &shear,
                 const Tensor<2, dim>                           &directions);
} // namespace Impoint

#endif
