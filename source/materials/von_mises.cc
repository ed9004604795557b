#include <impoint/materials/von_mises.h>

#include <cmath>

namespace Impoint
{
  namespace Materials
  {
    void VonMises::return_map(const std::array<double, 3> &trial_strain,
                              const double                 strength,
                              PrincipalReturn             &result) const
    {
      elastic_trial(moduli, trial_strain, result);
      const double mean =
        (result.stress[0] + result.stress[1] + result.stress[2]) / 3;
      std::array<double, 3> deviator;
      double                square = 0;
      for (int a = 0; a < 3; ++a)
        {
          deviator[a] = result.stress[a] - mean;
          square += deviator[a] * deviator[a];
        }
      const double trial = std::sqrt(1.5 * square);
      const double left  = strength * yield_stress / trial;
      if (trial - strength * yield_stress <=
          yield_tolerance(moduli, trial_strain))
        return;

      result.region = PrincipalReturn::Region::smooth;
      result.secant.fill(2 * moduli.mu * left);
      for (int a = 0; a < 3; ++a)
        {
          result.stress[a] = mean + left * deviator[a];
          for (int b = 0; b < 3; ++b)
            result.tangent[a][b] =
              moduli.bulk + 2 * moduli.mu * left *
                              ((a == b ? 1. : 0.) - 1. / 3 -
                               deviator[a] * deviator[b] / square);
        }
    }
  } // namespace Materials
} // namespace Impoint
