#ifndef impoint_tests_materials_elastic_limits_h
#define impoint_tests_materials_elastic_limits_h

#include <impoint/base/exceptions.h>
#include <impoint/materials/elastic_moduli.h>

#include <cmath>

#include "states.h"

inline const ElasticModuli moduli(1000, 0.2);

template <int dim>
Deformation<dim> unstretched()
{
  Deformation<dim> result;
  result.F = unit_symmetric_tensor<dim>();
  return result;
}

// to first order all laws agree; multiples of 2^-40 are exact in F, the
// principal values of this strain are not
template <template <int> class Model>
void small_strain(const std::string &name)
{
  const Model<3> material(moduli);
  Tensor<2, 3>   strain;
  strain[0][0] = strain[0][1] = strain[1][0] = std::ldexp(1., -40);
  strain[1][1]                               = std::ldexp(2., -40);
  const Tensor<2, 3> expected =
    moduli.lambda * trace(strain) * unstretched<3>().F + 2 * moduli.mu * strain;

  Deformation<3> block = unstretched<3>();
  block.F += strain;
  const auto found = response(material, block);
  report(name + " stress of strain 2^-40",
         (to_tensor<3>(found.stress) - expected).norm() / expected.norm(),
         1e-9);
  report(name + " energy of strain 2^-40",
         std::abs(material.energy(block, found) /
                    (0.5 * scalar_product(expected, strain)) -
                  1),
         1e-3);
}

template <template <int> class Model>
void inverted(const std::string &name)
{
  for (const double stretch : {-0.5, 0.})
    try
      {
        Deformation<2> point = unstretched<2>();
        point.F[0][0]        = stretch;
        response(Model<2>(moduli), point);
        std::cout << name << " accepts det F = " << stretch << '\n';
      }
    catch (const StepFailed &failure)
      {
        std::cout << name << ": " << failure.what() << '\n';
      }
}

template <template <int> class Model>
void check_finite(const std::string &name)
{
  small_strain<Model>(name);
  inverted<Model>(name);
}

#endif
