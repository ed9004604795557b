// Finite-strain plasticity from random elastic states: tangent against
// differences of the stress, objectivity, plane strain against 3D, the history.

#include <impoint/materials/drucker_prager.h>
#include <impoint/materials/mohr_coulomb.h>
#include <impoint/materials/von_mises.h>

#include "plastic_states.h"

template <int dim>
void check_states(const std::string &name, const Plastic<dim> &material)
{
  double             tangent = 0, objectivity = 0, memory = 0, jumps = 0;
  const unsigned int n_states = 3000;
  for (unsigned int n = 0; n < n_states; ++n)
    {
      const State<dim> state = random_state<dim>(material, n);
      const double     error = tangent_error(material, state);
      jumps += std::isnan(error);
      if (!std::isnan(error))
        raise(tangent, error);

      std::vector<double> after;
      const auto          here = state.answer(material, &after);
      const auto          Q    = random_rotation<dim>();
      const State<dim>    turned{state.history, Q * state.f};
      raise(objectivity,
            (to_tensor<dim>(turned.answer(material).stress) -
             Q * to_tensor<dim>(here.stress) * transpose(Q))
                .norm() /
              moduli.young);

      // what is remembered bears the stress in a step that does nothing
      after[kappa<dim>] = state.history[kappa<dim>];
      const State<dim> next{after, unit_symmetric_tensor<dim>()};
      const auto       again = next.answer(material);
      raise(memory, std::abs(again.stress_zz - here.stress_zz) / moduli.young);
      for (int k = 0; k < Voigt<dim>::n; ++k)
        raise(memory,
              std::abs(again.stress[k] - here.stress[k]) / moduli.young);
    }
  report(name + " tangent", tangent, 1e-7);
  report(name + " objectivity", objectivity, 1e-14);
  report(name + " memory", memory, 1e-14);
  report(name + " part of jumps", jumps / n_states, 0.05);
}

// a state of plane strain, in 3D
State<3> in_3d(const State<2> &state)
{
  const auto &old = state.history;
  State<3>    solid;
  solid.history = {old[0], old[1], old[3], old[2], 0, 0, old[4], old[5]};
  solid.f[2][2] = 1;
  for (int k = 0; k < 4; ++k)
    solid.f[k / 2][k % 2] = state.f[k / 2][k % 2];
  return solid;
}

template <typename Surface, typename... Numbers>
void check(const std::string &name,
           const Softening   &softening,
           const Numbers... numbers)
{
  const Plastic<2> flat(moduli,
                        std::make_unique<Surface>(moduli, numbers...),
                        softening,
                        true);
  const Plastic<3> solid(moduli,
                         std::make_unique<Surface>(moduli, numbers...),
                         softening,
                         true);
  check_states<2>(name + " 2D", flat);
  check_states<3>(name + " 3D", solid);

  const int in_plane[] = {0, 1, 3};
  double    error = 0, largest = 0;
  for (unsigned int n = 0; n < 1000; ++n)
    {
      const State<2>      state = random_state<2>(flat, n);
      std::vector<double> after_2d, after_3d;
      const auto          a = state.answer(flat, &after_2d);
      const auto          b = in_3d(state).answer(solid, &after_3d);
      raise(error, std::abs(a.stress_zz - b.stress[2]));
      for (int k = 0; k < 3; ++k)
        raise(error, std::abs(a.stress[k] - b.stress[in_plane[k]]));
      raise(error,
            moduli.young * std::abs(flat.plastic_strain(after_2d.data()) -
                                    solid.plastic_strain(after_3d.data())));
      raise(largest, after_2d[4] - state.history[4]);
    }
  report(name + " plane strain", error / moduli.young, 1e-14);
  if (!(largest > 1e-3))
    std::cout << "  no plastic strain\n";
}

// sand that is pulled apart has no stress and no stiffness, and none is left;
// pushed together it bears pressure at once or when it is closed
void torn_sand(const bool closes_gaps)
{
  const Plastic<2>    sand(moduli,
                        std::make_unique<MohrCoulomb>(moduli, 0, 20, 0),
                        Softening(),
                        closes_gaps);
  State<2>            state{std::vector<double>(sand.n_history(), 0.),
                 1.1 * unit_symmetric_tensor<2>()};
  std::vector<double> after;
  const auto          torn    = state.answer(sand, &after);
  double              largest = 0;
  for (const double entry : torn.tangent)
    raise(largest, std::abs(entry));
  for (const double entry : torn.stress)
    raise(largest, std::abs(entry));
  for (int k = 0; k < 4; ++k)
    raise(largest, std::abs(after[k]));
  report("torn sand: stress, tangent, elastic strain", largest, 1e-300);

  const State<2> together{after, 1 / 1.1 * unit_symmetric_tensor<2>()};
  const double   pressure = -together.answer(sand, &after).stress[0];
  const State<2> pressed{after, 0.99 * unit_symmetric_tensor<2>()};
  std::cout << "  pressure when closed: " << (pressure > 1e-10)
            << ", then pressed: " << (pressed.answer(sand).stress[0] < -10)
            << '\n';
}

void softening()
{
  const Softening soft{0.2, 0.1};
  report("softening",
         std::abs(soft.strength(0) - 1) + std::abs(soft.strength(100) - 0.2) +
           std::abs(soft.strength(0.1) - (0.2 + 0.8 * std::exp(-1))),
         1e-15);
}

int main()
{
  check<MohrCoulomb>("Mohr-Coulomb, sand", Softening(), 0., 19.8, 0.);
  check<MohrCoulomb>("Mohr-Coulomb, soil", Softening{0.5, 0.1}, 5., 30., 10.);
  check<DruckerPrager>("Drucker-Prager", Softening{0.5, 0.1}, 5., 30., 10.);
  check<VonMises>("von Mises", Softening(), 9.);
  torn_sand(true);
  torn_sand(false);
  softening();
}
