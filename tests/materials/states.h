#ifndef impoint_tests_materials_states_h
#define impoint_tests_materials_states_h

#include <impoint/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <iostream>
#include <random>
#include <vector>

using namespace Impoint;
using namespace Impoint::Materials;

inline std::mt19937 generator(7);

inline double random_number(const double from, const double to)
{
  return from + (to - from) * (generator() / 4294967296.);
}

// "no" with the error shows what numdiff cannot see
inline void
report(const std::string &what, const double error, const double bound)
{
  std::cout << what << " below " << bound << ": ";
  error < bound ? std::cout << "yes\n" : std::cout << "no, " << error << "\n";
}

// the larger one, NaN above all
inline void raise(double &worst, const double value)
{
  if (!std::isnan(worst) && !(value <= worst))
    worst = value;
}

template <int dim>
Tensor<2, dim> random_rotation()
{
  Tensor<2, dim> Q = unit_symmetric_tensor<dim>();
  for (int k = dim; k < Voigt<dim>::n; ++k)
    {
      const int      i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
      const double   angle = random_number(-3, 3);
      Tensor<2, dim> plane = unit_symmetric_tensor<dim>();
      plane[i][i] = plane[j][j] = std::cos(angle);
      plane[i][j]               = -std::sin(angle);
      plane[j][i]               = std::sin(angle);
      Q                         = plane * Q;
    }
  return Q;
}

// deformation gradients: 1, rotations, one stretch, equal ones up to a
// difference of 1e-9, anything
template <int dim>
std::vector<Tensor<2, dim>> states()
{
  std::vector<Tensor<2, dim>> result;
  for (unsigned int n = 0; n < 300; ++n)
    {
      Tensor<2, dim> U = unit_symmetric_tensor<dim>();
      for (int i = 0; i < dim; ++i)
        U[i][i] = n < 20 || (n < 40 && i > 0) ? 1. :
                  n < 60                      ? 1.5 + 1e-9 * i :
                                                random_number(0.3, 3);
      const Tensor<2, dim> Q = random_rotation<dim>();
      result.push_back(n < 10 ? U :
                                random_rotation<dim>() * Q * U * transpose(Q));
    }
  return result;
}

// as after displacement (1 + step d) F from a stressed state
template <int dim>
Deformation<dim> deformed(const Tensor<2, dim> &F,
                          const Tensor<2, dim> &d    = Tensor<2, dim>(),
                          const double          step = 0)
{
  Deformation<dim> result;
  result.F              = F + step * d * F;
  result.grad_increment = displacement_gradient(F) + step * d;
  for (int k = 0; k < Voigt<dim>::n; ++k)
    result.old_stress[k] = k < dim ? 10. * (k + 1) : 40. - 10. * k;
  result.old_stress[dim] = -20; // 01
  result.old_stress_zz   = 30;
  return result;
}

template <int dim>
Response<dim> response(const Material<dim>    &material,
                       const Deformation<dim> &deformation)
{
  Response<dim> result;
  material.respond(deformation, nullptr, nullptr, true, result);
  return result;
}

#endif
