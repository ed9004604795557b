// Elastic models: known values, small strains without loss of digits, refusal
// of det F <= 0.

#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>

#include <cmath>

#include "elastic_limits.h"

void compare(const std::string &what, const double value, const double expected)
{
  report(what, std::abs(value / expected - 1), 1e-12);
}

// E = 1000, nu = 0.2, shortened by 0.001, sides free of stress
void uniaxial_st_venant_kirchhoff()
{
  Deformation<3> bar = unstretched<3>();
  bar.F[0][0] = bar.F[2][2] = std::sqrt(1 + 2 * 0.0001999);
  bar.F[1][1]               = 0.999;
  const auto tau = response(StVenantKirchhoff<3>(moduli), bar).stress;
  compare("St. Venant-Kirchhoff Cauchy stress",
          tau[1] / determinant(bar.F),
          -0.9981014590366637);
  report("its sides' stress", std::abs(tau[0]) + std::abs(tau[2]), 1e-12);
}

void swollen_neo_hookean()
{
  Deformation<3> ball = unstretched<3>();
  ball.F *= 1.1;
  compare("neo-Hookean, stretch 1.1 in all directions",
          response(NeoHookean<3>(moduli), ball).stress[1],
          moduli.mu * 0.21 + 3 * moduli.lambda * std::log(1.1));
}

// stretches exp(0.5) and exp(-0.5) along the diagonals: eps_01 = 0.5
void sheared_hencky()
{
  Deformation<2> square = unstretched<2>();
  square.F[0][0] = square.F[1][1] = std::cosh(0.5);
  square.F[0][1] = square.F[1][0] = std::sinh(0.5);
  compare("Hencky, pure shear",
          response(Hencky<2>(moduli), square).stress[2],
          2 * moduli.mu * 0.5);
  square.F *= std::exp(0.1);
  compare("Hencky, pure shear and swelling, stress zz",
          response(Hencky<2>(moduli), square).stress_zz,
          moduli.lambda * 0.2);
}

void two_increments()
{
  const LinearElastic<2> material(moduli);
  Deformation<2>         step = unstretched<2>();
  step.grad_increment[0][0]   = 0.001;
  step.grad_increment[0][1]   = 0.004;
  auto first                  = response(material, step);
  step.old_stress             = first.stress;
  step.old_stress_zz          = first.stress_zz;
  const auto second           = response(material, step);
  compare("linear elastic, normal stress after two steps",
          second.stress[0],
          0.002 * (moduli.lambda + 2 * moduli.mu));
  compare("linear elastic, shear stress after two steps",
          second.stress[2],
          0.008 * moduli.mu);
  compare("linear elastic, stress zz after two steps",
          second.stress_zz,
          0.002 * moduli.lambda);
  compare("linear elastic, energy after two steps",
          material.energy(step, second),
          0.5 * (second.stress[0] * 0.002 + second.stress[2] * 0.008));
}

int main()
{
  uniaxial_st_venant_kirchhoff();
  swollen_neo_hookean();
  sheared_hencky();
  two_increments();
  check_finite<StVenantKirchhoff>("St. Venant-Kirchhoff");
  check_finite<NeoHookean>("neo-Hookean");
  check_finite<Hencky>("Hencky");
}
