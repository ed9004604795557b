#include <impoint/base/exceptions.h>
#include <impoint/base/tensor_functions.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace Impoint
{
  void throw_not_positive(const double J)
  {
    std::ostringstream message;
    message << "det F = " << J << " at a material point, not above 0";
    throw StepFailed(message.str());
  }



  namespace
  {
    /** Turns the frame in the plane of axes @p p and @p q so that A_pq = 0. */
    template <int p, int q, int dim>
    inline void jacobi_rotation(VoigtVector<dim> &A, Tensor<2, dim> &directions)
    {
      constexpr int pq = Voigt<dim>::position(p, q);
      if (A[pq] == 0)
        return;

      const double difference = A[q] - A[p];
      const double tangent =
        std::copysign(2., difference) * A[pq] /
        (std::abs(difference) +
         std::sqrt(difference * difference + 4 * A[pq] * A[pq]));
      const double cosine = 1 / std::sqrt(1 + tangent * tangent);
      const double sine   = tangent * cosine;

      const auto turn = [cosine, sine](double &along_p, double &along_q) {
        const double old_p = along_p;
        along_p            = cosine * old_p - sine * along_q;
        along_q            = sine * old_p + cosine * along_q;
      };

      A[p] -= tangent * A[pq];
      A[q] += tangent * A[pq];
      A[pq] = 0;
      if constexpr (dim == 3)
        turn(A[Voigt<dim>::position(p, 3 - p - q)],
             A[Voigt<dim>::position(q, 3 - p - q)]);
      for (int i = 0; i < dim; ++i)
        turn(directions[p][i], directions[q][i]);
    }



    template <int dim>
    inline double off_diagonal_square(const VoigtVector<dim> &A)
    {
      double sum = 0;
      for (int k = dim; k < Voigt<dim>::n; ++k)
        sum += A[k] * A[k];
      return sum;
    }
  } // namespace



  template <int dim>
  Spectrum<dim> spectrum(const VoigtVector<dim> &symmetric)
  {
    Spectrum<dim> result;
    for (int i = 0; i < dim; ++i)
      result.directions[i][i] = 1;

    VoigtVector<dim> A = symmetric;
    if constexpr (dim == 2) // one rotation is the exact answer
      jacobi_rotation<0, 1, dim>(A, result.directions);
    else
      {
        const double negligible =
          0.25 * std::numeric_limits<double>::epsilon() *
          std::numeric_limits<double>::epsilon() * voigt_square<dim>(symmetric);
        // about four sweeps
        constexpr unsigned int max_sweeps = 30;
        for (unsigned int sweep = 0;
             sweep < max_sweeps && off_diagonal_square<dim>(A) > negligible;
             ++sweep)
          {
            jacobi_rotation<0, 1, dim>(A, result.directions);
            jacobi_rotation<0, 2, dim>(A, result.directions);
            jacobi_rotation<1, 2, dim>(A, result.directions);
          }
      }

    for (int a = 0; a < dim; ++a)
      result.values[a] = A[a];
    return result;
  }



  template <int dim>
  VoigtVector<dim> from_principal(const std::array<double, dim> &values,
                                  const Tensor<2, dim>          &directions)
  {
    VoigtVector<dim> result = {};
    for (int a = 0; a < dim; ++a)
      for (int k = 0; k < Voigt<dim>::n; ++k)
        result[k] += values[a] * directions[a][Voigt<dim>::row(k)] *
                     directions[a][Voigt<dim>::column(k)];
    return result;
  }



  template <int dim>
  VoigtMatrix<dim>
  from_principal(const std::array<std::array<double, dim>, dim> &normal,
                 const std::array<double, Voigt<dim>::n - dim>  &shear,
                 const Tensor<2, dim>                           &directions)
  {
    constexpr int n = Voigt<dim>::n;

    // column m holds the tensor n_a n_b + n_b n_a (n_a n_a) of component m
    std::array<std::array<double, n>, n> base;
    for (int k = 0; k < n; ++k)
      for (int m = 0; m < n; ++m)
        {
          const int i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
          const int a = Voigt<dim>::row(m), b = Voigt<dim>::column(m);
          base[k][m] = directions[a][i] * directions[b][j];
          if (a != b)
            base[k][m] += directions[b][i] * directions[a][j];
        }

    VoigtMatrix<dim> result;
    for (int k = 0; k < n; ++k)
      {
        std::array<double, n> half; // row k of base * (normal, shear)
        for (int b = 0; b < dim; ++b)
          {
            half[b] = 0;
            for (int a = 0; a < dim; ++a)
              half[b] += base[k][a] * normal[a][b];
          }
        for (int m = dim; m < n; ++m)
          half[m] = base[k][m] * shear[m - dim];

        for (int l = 0; l < n; ++l)
          {
            double sum = 0;
            for (int m = 0; m < n; ++m)
              sum += half[m] * base[l][m];
            result[k * n + l] = sum;
          }
      }
    return result;
  }
} // namespace Impoint

template Impoint::Spectrum<2> Impoint::spectrum<2>(const VoigtVector<2> &);
template Impoint::Spectrum<3> Impoint::spectrum<3>(const VoigtVector<3> &);

template Impoint::VoigtVector<2>
Impoint::from_principal<2>(const std::array<double, 2> &, const Tensor<2, 2> &);
template Impoint::VoigtVector<3>
Impoint::from_principal<3>(const std::array<double, 3> &, const Tensor<2, 3> &);

template Impoint::VoigtMatrix<2>
Impoint::from_principal<2>(const std::array<std::array<double, 2>, 2> &,
                           const std::array<double, 1> &,
                           const Tensor<2, 2> &);
template Impoint::VoigtMatrix<3>
Impoint::from_principal<3>(const std::array<std::array<double, 3>, 3> &,
                           const std::array<double, 3> &,
                           const Tensor<2, 3> &);
