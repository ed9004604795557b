#ifndef impoint_tests_materials_plastic_states_h
#define impoint_tests_materials_plastic_states_h

#include <impoint/materials/elastoplastic.h>

#include "states.h"

inline const ElasticModuli moduli(1000, 0.3);

template <int dim>
using Plastic = Elastoplastic<dim>;

// where the equivalent plastic strain stands in the history
template <int dim>
constexpr int kappa = dim == 2 ? 4 : 6;

// history and gradient of the step
template <int dim>
struct State
{
  std::vector<double> history;
  Tensor<2, dim>      f;

  Response<dim> answer(const Plastic<dim>  &material,
                       std::vector<double> *after = nullptr) const
  {
    Deformation<dim> deformation;
    deformation.grad_increment = displacement_gradient(f);
    Response<dim>       result;
    std::vector<double> new_history(history.size());
    material.respond(
      deformation, history.data(), new_history.data(), true, result);
    if (after)
      *after = new_history;
    return result;
  }
};

template <int dim>
State<dim> random_state(const Plastic<dim> &material, const unsigned int n)
{
  // three in ten are compressed, stretched, or sheared alike in the plane
  const double  mean = n % 10 == 0 ? -20 : random_number(-20, 8);
  Response<dim> stress;
  for (int k = 0; k < Voigt<dim>::n; ++k)
    stress.stress[k] =
      (k < dim ? mean : 0.) + (n % 10 < 3 ? 0. : random_number(-7, 7));
  stress.stress_zz = dim == 2 ? mean + random_number(-3, 3) : 0.;
  State<dim> state;
  state.history.resize(material.n_history());
  material.initialise(stress, state.history.data());
  state.history[kappa<dim>] = random_number(0, 0.1);
  state.history.back()      = n % 4 == 0 ? random_number(0, 0.01) : 0.; // open
  for (int k = 0; k < dim * dim; ++k)
    state.f[k / dim][k % dim] =
      (k / dim == k % dim ? 1. : 0.) + random_number(-0.01, 0.01);
  state.f = random_rotation<dim>() * state.f;
  return state;
}

// tau f^-T's rate is c : sym d + d tau for a step that goes on with d; returns
// the error, or NaN where the tangent jumps on the way
template <int dim>
double tangent_error(const Plastic<dim> &material, const State<dim> &state)
{
  constexpr int  n = Voigt<dim>::n;
  const double   h = 1e-6;
  Tensor<2, dim> d;
  for (int k = 0; k < dim * dim; ++k)
    d[k / dim][k % dim] = random_number(-1, 1);

  const auto       here   = state.answer(material);
  const auto       strain = engineering_strain(d);
  VoigtVector<dim> rate   = {};
  for (int k = 0; k < n * n; ++k)
    rate[k / n] += here.tangent[k] * strain[k % n];
  Tensor<2, dim> difference =
    -1. * (to_tensor<dim>(rate) + d * to_tensor<dim>(here.stress));

  const double from[] = {-2, -1, 1, 2};
  const double with[] = {1, -8, 8, -1};
  for (int i = 0; i < 4; ++i)
    {
      const Tensor<2, dim> g = unit_symmetric_tensor<dim>() + from[i] * h * d;
      const State<dim>     moved{state.history, g * state.f};
      const auto           there = moved.answer(material);
      for (int k = 0; k < n * n; ++k)
        if (std::abs(there.tangent[k] - here.tangent[k]) > 1e-2 * moduli.young)
          return std::nan("");
      difference += with[i] / (12 * h) * to_tensor<dim>(there.stress) *
                    transpose(invert(g));
    }
  return difference.norm() / moduli.young;
}

#endif
