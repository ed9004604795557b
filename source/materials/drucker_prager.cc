#include <impoint/materials/drucker_prager.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>

namespace Impoint
{
  namespace Materials
  {
    using namespace dealii;

    namespace
    {
      double slope(const double degrees)
      {
        const double sine = std::sin(degrees * numbers::PI / 180);
        return 6 * sine / (std::sqrt(3.) * (3 - sine));
      }
    } // namespace



    DruckerPrager::DruckerPrager(const ElasticModuli &moduli,
                                 const double         cohesion,
                                 const double         friction,
                                 const double         dilation)
      : YieldSurface(moduli)
      , eta(slope(friction))
      , eta_dilation(slope(dilation))
    {
      Assert(cohesion > 0 || friction > 0,
             ExcMessage("Neither friction nor cohesion."));
      const double angle = friction * numbers::PI / 180;
      resistance         = cohesion * 6 * std::cos(angle) /
                   (std::sqrt(3.) * (3 - std::sin(angle)));
    }



    double DruckerPrager::yield_function(const std::array<double, 3> &stress,
                                         const double strength) const
    {
      const double mean = (stress[0] + stress[1] + stress[2]) / 3;
      double       J_2  = 0;
      for (const double value : stress)
        J_2 += 0.5 * (value - mean) * (value - mean);
      return std::sqrt(J_2) + eta * mean - strength * resistance;
    }



    // With n the trial deviator over its sqrt(J_2), and a step along the cone's
    // normal of gamma = f / (mu + K eta eta'): tau = tau_trial - gamma (mu n +
    // K eta' 1), unless the deviator would turn round: then the apex.
    void DruckerPrager::return_map(const std::array<double, 3> &trial_strain,
                                   const double                 strength,
                                   PrincipalReturn             &result) const
    {
      elastic_trial(moduli, trial_strain, result);
      const double f = yield_function(result.stress, strength);
      if (f <= yield_tolerance(moduli, trial_strain))
        return;

      const double mu = moduli.mu, K = moduli.bulk;
      const double mean =
        (result.stress[0] + result.stress[1] + result.stress[2]) / 3;
      const double root_J_2           = f - eta * mean + strength * resistance;
      const double resistance_to_step = mu + K * eta * eta_dilation;
      const double gamma              = f / resistance_to_step;
      if (!(root_J_2 > mu * gamma))
        {
          result.region = PrincipalReturn::Region::apex;
          result.stress.fill(strength * resistance / eta);
          for (auto &row : result.tangent)
            row.fill(0);
          result.secant.fill(0);
          return;
        }

      result.region       = PrincipalReturn::Region::smooth;
      const double shrunk = mu * gamma / root_J_2;
      result.secant.fill(2 * mu * (1 - shrunk));
      std::array<double, 3> n;
      for (int a = 0; a < 3; ++a)
        n[a] = (result.stress[a] - mean) / root_J_2;
      for (int a = 0; a < 3; ++a)
        {
          result.stress[a] -= gamma * (mu * n[a] + K * eta_dilation);
          for (int b = 0; b < 3; ++b)
            result.tangent[a][b] =
              2 * mu * (1 - shrunk) * ((a == b ? 1. : 0.) - 1. / 3) + K +
              shrunk * mu * n[a] * n[b] -
              (mu * n[a] + K * eta_dilation) * (mu * n[b] + K * eta) /
                resistance_to_step;
        }
    }
  } // namespace Materials
} // namespace Impoint
