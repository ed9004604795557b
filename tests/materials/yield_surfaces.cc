// Return mappings in principal strains at random states of every region, with
// repeated values: stress on the surface, in the order of the trial strains,
// and tangent and secants against differences.

#include <impoint/materials/drucker_prager.h>
#include <impoint/materials/mohr_coulomb.h>
#include <impoint/materials/von_mises.h>

#include <algorithm>
#include <map>

#include "states.h"

using Values = std::array<double, 3>;
using Region = PrincipalReturn::Region;

const ElasticModuli moduli(1000, 0.3);
const double        strength = 0.7;

double excess(const MohrCoulomb &surface, const Values &stress)
{
  return surface.yield_function(stress, strength);
}

double excess(const DruckerPrager &surface, const Values &stress)
{
  return surface.yield_function(stress, strength);
}

// that of a yield stress of 9
double excess(const VonMises &, const Values &stress)
{
  const double a = stress[0] - stress[1], b = stress[1] - stress[2],
               c = stress[2] - stress[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c)) - strength * 9;
}

// anything; two or three equal values; two equal up to 1e-9
Values random_strain(const unsigned int n)
{
  const double mean = random_number(-0.03, 0.03);
  Values       strain;
  for (double &value : strain)
    value = mean + random_number(-0.02, 0.02);
  if (n % 7 < 4 && n % 7 > 0)
    strain[n % 3] = strain[(n + 1) % 3] + (n % 7 == 3 ? 1e-9 : 0.);
  if (n % 50 == 1)
    strain.fill(mean);
  return strain;
}

// by differences of fourth order; NaN where the region changes on the way
template <typename Surface>
Values derivative(const Surface  &surface,
                  const Values   &strain,
                  const Values   &direction,
                  const Region    region,
                  PrincipalReturn there)
{
  // small beside the way to the cone's tip, where its curvature is large
  const double h      = 2e-6;
  const double from[] = {-2, -1, 1, 2};
  const double with[] = {1, -8, 8, -1};
  Values       rate   = {};
  for (int k = 0; k < 4; ++k)
    {
      Values moved = strain;
      for (int a = 0; a < 3; ++a)
        moved[a] += from[k] * h * direction[a];
      surface.return_map(moved, strength, there);
      for (int a = 0; a < 3; ++a)
        rate[a] += there.region == region ?
                     with[k] * there.stress[a] / (12 * h) :
                     std::nan("");
    }
  return rate;
}

template <typename Surface>
void check(const std::string &name, const Surface &surface)
{
  double off = 0, order = 0, tangent = 0, secant = 0, crossed = 0;
  std::map<Region, unsigned int> counts;
  const unsigned int             n_states = 6000;
  for (unsigned int n = 0; n < n_states; ++n)
    {
      const Values    strain = random_strain(n);
      PrincipalReturn result;
      surface.return_map(strain, strength, result);
      ++counts[result.region];
      const double f = excess(surface, result.stress) / moduli.young;
      raise(off, result.region == Region::elastic ? f : std::abs(f));
      for (int a = 0; a < 3; ++a)
        for (int b = a + 1; b < 3; ++b)
          {
            const double way   = strain[a] - strain[b];
            const double force = result.stress[a] - result.stress[b];
            raise(order, -way * force);
            if (std::abs(way) > 1e-4)
              raise(secant,
                    std::abs(result.secant[pair_of(a, b)] - force / way) /
                      moduli.young);
          }

      Values direction;
      for (double &value : direction)
        value = random_number(-1, 1);
      const Values rate =
        derivative(surface, strain, direction, result.region, result);
      crossed += std::isnan(rate[0]);
      for (int a = 0; a < 3 && !std::isnan(rate[0]); ++a)
        {
          double expected = 0;
          for (int b = 0; b < 3; ++b)
            expected += result.tangent[a][b] * direction[b];
          raise(tangent, std::abs(rate[a] - expected) / moduli.young);
        }
    }
  std::cout << name << ", regions met at least 100 times:";
  for (const auto &count : counts)
    if (count.second >= 100)
      std::cout << ' ' << static_cast<int>(count.first);
  std::cout << (crossed < 0.1 * n_states ? "\n" : ", hardly compared\n");
  report("  f / E of elastic states, |f| / E of others", off, 1e-15);
  report("  stresses in the wrong order", order, 1e-15);
  report("  error of tangent / E", tangent, 1e-8);
  report("  error of secants / E", secant, 1e-10);
}

int main()
{
  check("Mohr-Coulomb, sand", MohrCoulomb(moduli, 0, 19.8, 0));
  check("Mohr-Coulomb, soil", MohrCoulomb(moduli, 5, 30, 10));
  check("Mohr-Coulomb, associated", MohrCoulomb(moduli, 5, 30, 30));
  check("Tresca", MohrCoulomb(moduli, 5, 0, 0));
  check("Drucker-Prager, sand", DruckerPrager(moduli, 0, 30, 0));
  check("Drucker-Prager, soil", DruckerPrager(moduli, 5, 30, 10));
  check("von Mises", VonMises(moduli, 9));
}
