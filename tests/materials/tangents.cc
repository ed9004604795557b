// Elastic models at random states: derivative of stress against the tangent,
// derivative of energy against stress, objectivity, plane strain against 3D;
// the models' logarithms.

#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>

#include <cmath>

#include "states.h"

template <typename Function>
auto derivative(const Function &f)
{
  const double h = 1e-3;
  return (8. * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

// for dF = d F: dP F^T = c : sym d + d tau, dW = tau : d; errors of both
// over the largest entry of c
template <int dim>
std::array<double, 2> derivative_errors(const Material<dim>  &material,
                                        const Tensor<2, dim> &F,
                                        const Tensor<2, dim> &d)
{
  const auto stress = [&](const double step) {
    const auto there = deformed(F, d, step);
    const auto tau   = to_tensor<dim>(response(material, there).stress);
    return material.small_strain() ? tau : tau * transpose(F * invert(there.F));
  };
  const auto energy = [&](const double step) {
    const auto there = deformed(F, d, step);
    return material.energy(there, response(material, there));
  };

  constexpr int          n      = Voigt<dim>::n;
  const auto             here   = response(material, deformed(F));
  const VoigtVector<dim> strain = engineering_strain(d);
  VoigtVector<dim>       rate   = {};
  double                 scale  = 0;
  for (int k = 0; k < n * n; ++k)
    {
      rate[k / n] += here.tangent[k] * strain[k % n];
      scale = std::max(scale, std::abs(here.tangent[k]));
    }
  Tensor<2, dim> expected = to_tensor<dim>(rate);
  if (!material.small_strain())
    expected += d * stress(0);
  return {
    {(derivative(stress) - expected).norm() / scale,
     std::abs(derivative(energy) - scalar_product(stress(0), d)) / scale}};
}

template <int dim>
void check_states(const std::string &name, const Material<dim> &material)
{
  double tangent_error = 0, energy_error = 0, objectivity_error = 0;
  for (const Tensor<2, dim> &F : states<dim>())
    {
      Tensor<2, dim> d;
      for (int k = 0; k < dim * dim; ++k)
        d[k / dim][k % dim] = random_number(-1, 1);
      const auto errors = derivative_errors(material, F, d);
      raise(tangent_error, errors[0]);
      raise(energy_error, errors[1]);

      const auto Q   = random_rotation<dim>();
      const auto tau = to_tensor<dim>(response(material, deformed(F)).stress);
      const auto turned =
        to_tensor<dim>(response(material, deformed<dim>(Q * F)).stress);
      raise(objectivity_error,
            (turned - Q * tau * transpose(Q)).norm() / (1000 + tau.norm()));
    }
  report(name + " tangent", tangent_error, 1e-9);
  report(name + " energy", energy_error, 1e-9);
  if (!material.small_strain())
    report(name + " objectivity", objectivity_error, 1e-13);
}

template <template <int> class Model>
void check(const std::string &name)
{
  const ElasticModuli moduli(1000, 0.3);
  const Model<2>      plane(moduli);
  const Model<3>      solid(moduli);
  check_states<2>(name + " 2D", plane);
  check_states<3>(name + " 3D", solid);

  const int in_plane[] = {0, 1, 3};
  double    error      = 0;
  for (const Tensor<2, 2> &F : states<2>())
    {
      Tensor<2, 3> F_solid;
      F_solid[2][2] = 1;
      for (int k = 0; k < 4; ++k)
        F_solid[k / 2][k % 2] = F[k / 2][k % 2];
      const auto flat  = response(plane, deformed(F));
      const auto whole = response(solid, deformed(F_solid));

      raise(error, std::abs(flat.stress_zz - whole.stress[2]));
      for (int k = 0; k < 3; ++k)
        {
          const int row = in_plane[k];
          raise(error, std::abs(flat.stress[k] - whole.stress[row]));
          for (int l = 0; l < 3; ++l)
            raise(error,
                  std::abs(flat.tangent[k * 3 + l] -
                           whole.tangent[row * 6 + in_plane[l]]));
        }
    }
  report(name + " plane strain", error / moduli.young, 1e-12);
}

// on both sides of where they become the library's
void logarithms()
{
  double error = 0;
  for (int n = -2000; n <= 2000; ++n)
    for (const double x : {1e-5 * n, 1e-12 * n})
      if (x != 0)
        {
          raise(error, std::abs(log_one_plus(x) / std::log1p(x) - 1));
          raise(error, std::abs(exp_minus_one(x) / std::expm1(x) - 1));
        }
  report("ln(1 + x), exp(x) - 1 against the library's", error, 4e-16);
}

int main()
{
  logarithms();
  check<LinearElastic>("linear elastic");
  check<StVenantKirchhoff>("St. Venant-Kirchhoff");
  check<NeoHookean>("neo-Hookean");
  check<Hencky>("Hencky");
}
