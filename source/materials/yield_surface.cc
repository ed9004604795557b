#include <impoint/materials/yield_surface.h>

#include <cmath>
#include <limits>

namespace Impoint
{
  namespace Materials
  {
    void elastic_trial(const ElasticModuli         &moduli,
                       const std::array<double, 3> &trial_strain,
                       PrincipalReturn             &result)
    {
      const double pressure =
        moduli.lambda * (trial_strain[0] + trial_strain[1] + trial_strain[2]);
      result.region = PrincipalReturn::Region::elastic;
      for (int a = 0; a < 3; ++a)
        {
          result.stress[a] = pressure + 2 * moduli.mu * trial_strain[a];
          result.tangent[a].fill(moduli.lambda);
          result.tangent[a][a] += 2 * moduli.mu;
        }
      result.secant.fill(2 * moduli.mu);
    }



    std::array<double, 3> elastic_strain(const ElasticModuli         &moduli,
                                         const std::array<double, 3> &stress)
    {
      // lambda tr eps with tr eps = tr tau / (3 K)
      const double pressure =
        moduli.lambda * (stress[0] + stress[1] + stress[2]) / (3 * moduli.bulk);
      std::array<double, 3> strain;
      for (int a = 0; a < 3; ++a)
        strain[a] = (stress[a] - pressure) / (2 * moduli.mu);
      return strain;
    }



    double yield_tolerance(const ElasticModuli         &moduli,
                           const std::array<double, 3> &strain)
    {
      const double size =
        std::abs(strain[0]) + std::abs(strain[1]) + std::abs(strain[2]);
      return 4 * std::numeric_limits<double>::epsilon() *
             (moduli.lambda + 2 * moduli.mu) * size;
    }
  } // namespace Materials
} // namespace Impoint
