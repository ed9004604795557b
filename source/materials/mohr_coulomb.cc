#include <impoint/materials/mohr_coulomb.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Impoint
{
  namespace Materials
  {
    using namespace dealii;

    namespace
    {
      using Vector = std::array<double, 3>;
      using Region = PrincipalReturn::Region;

      /** Gradient of a plane of the surface or its potential: it grows with
       * the stress of axis @p major and falls with that of axis @p minor. */
      struct Plane
      {
        int major, minor;

        Vector gradient(const double sine) const
        {
          Vector a = {};
          a[major] = 1 + sine;
          a[minor] = sine - 1;
          return a;
        }
      };



      double dot(const Vector &a, const Vector &b)
      {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      }



      Vector elastic_product(const ElasticModuli &moduli, const Vector &strain)
      {
        const double pressure =
          moduli.lambda * (strain[0] + strain[1] + strain[2]);
        Vector stress;
        for (int a = 0; a < 3; ++a)
          stress[a] = pressure + 2 * moduli.mu * strain[a];
        return stress;
      }



      /** Inverse of the n x n matrix a_i . D b_j, n = 1 or 2. */
      template <int n>
      std::array<std::array<double, n>, n>
      inverse_moduli(const std::array<Vector, n> &a,
                     const std::array<Vector, n> &D_b)
      {
        std::array<std::array<double, n>, n> result;
        if constexpr (n == 1)
          result[0][0] = 1 / dot(a[0], D_b[0]);
        else
          {
            const double m00 = dot(a[0], D_b[0]), m01 = dot(a[0], D_b[1]);
            const double m10 = dot(a[1], D_b[0]), m11 = dot(a[1], D_b[1]);
            const double determinant = m00 * m11 - m01 * m10;
            result[0] = {{m11 / determinant, -m01 / determinant}};
            result[1] = {{-m10 / determinant, m00 / determinant}};
          }
        return result;
      }
    } // namespace



    MohrCoulomb::MohrCoulomb(const double cohesion,
                             const double friction,
                             const double dilation)
      : cohesion(cohesion)
      , sin_friction(std::sin(friction * numbers::PI / 180))
      , cos_friction(std::cos(friction * numbers::PI / 180))
      , sin_dilation(std::sin(dilation * numbers::PI / 180))
    {
      Assert(cohesion > 0 || friction > 0,
             ExcMessage("Neither friction nor cohesion."));
    }



    double MohrCoulomb::yield_function(Vector       stress,
                                       const double strength) const
    {
      std::sort(stress.begin(), stress.end(), std::greater<double>());
      return (1 + sin_friction) * stress[0] - (1 - sin_friction) * stress[2] -
             2 * strength * cohesion * cos_friction;
    }



    namespace
    {
      /**
       * Returns the trial stress to where the n planes meet (Koiter's rule):
       * tau = tau_trial - D b_j G^-1_ji f_i with G_ij = a_i . D b_j.
       */
      template <int n>
      void return_to(const std::array<Plane, n> &planes,
                     const double                sin_friction,
                     const double                sin_dilation,
                     const double                resistance, // 2 c cos phi
                     const ElasticModuli        &moduli,
                     const Vector               &trial_stress,
                     PrincipalReturn            &result)
      {
        std::array<Vector, n> a, D_a, D_b;
        std::array<double, n> excess;
        for (int i = 0; i < n; ++i)
          {
            a[i]   = planes[i].gradient(sin_friction);
            D_a[i] = elastic_product(moduli, a[i]);
            D_b[i] = elastic_product(moduli, planes[i].gradient(sin_dilation));
            excess[i] = dot(a[i], trial_stress) - resistance;
          }
        const auto inverse = inverse_moduli<n>(a, D_b);

        result.stress = trial_stress;
        for (int k = 0; k < 3; ++k)
          {
            result.tangent[k].fill(moduli.lambda);
            result.tangent[k][k] += 2 * moduli.mu;
          }
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            for (int k = 0; k < 3; ++k)
              {
                const double way = D_b[j][k] * inverse[j][i];
                result.stress[k] -= way * excess[i];
                for (int l = 0; l < 3; ++l)
                  result.tangent[k][l] -= way * D_a[i][l];
              }
      }



      /** Secants of the axes from stresses and strains in order; between 0 and
       * that of elasticity, for the order of stresses is that of strains. */
      void set_secants(const double     elastic,
                       const Vector    &strain,
                       PrincipalReturn &result)
      {
        for (int a = 0; a < 3; ++a)
          for (int b = a + 1; b < 3; ++b)
            {
              const double way = strain[a] - strain[b];
              const double secant =
                way == 0 ? 0 : (result.stress[a] - result.stress[b]) / way;
              result.secant[pair_of(a, b)] =
                std::min(std::max(secant, 0.), elastic);
            }
      }



      /** From descending order back to that of the caller. */
      void reorder(const std::array<int, 3> &order, PrincipalReturn &result)
      {
        const PrincipalReturn sorted = result;
        for (int a = 0; a < 3; ++a)
          {
            result.stress[order[a]] = sorted.stress[a];
            for (int b = 0; b < 3; ++b)
              {
                result.tangent[order[a]][order[b]] = sorted.tangent[a][b];
                if (a != b)
                  result.secant[pair_of(order[a], order[b])] =
                    sorted.secant[pair_of(a, b)];
              }
          }
      }
    } // namespace



    void MohrCoulomb::return_map(const ElasticModuli &moduli,
                                 const Vector        &trial_strain,
                                 const double         strength,
                                 PrincipalReturn     &result) const
    {
      elastic_trial(moduli, trial_strain, result);
      if (yield_function(result.stress, strength) <=
          yield_tolerance(moduli, trial_strain))
        return;

      std::array<int, 3> order = {{0, 1, 2}};
      std::sort(order.begin(), order.end(), [&](const int a, const int b) {
        return trial_strain[a] > trial_strain[b];
      });
      Vector strain, trial_stress;
      for (int a = 0; a < 3; ++a)
        {
          strain[a]       = trial_strain[order[a]];
          trial_stress[a] = result.stress[order[a]];
        }

      const double resistance = 2 * strength * cohesion * cos_friction;
      const auto   go_to      = [&](const Region region, const auto &planes) {
        return_to<std::tuple_size_v<std::decay_t<decltype(planes)>>>(
          planes,
          sin_friction,
          sin_dilation,
          resistance,
          moduli,
          trial_stress,
          result);
        result.region = region;
      };
      const Plane main = {0, 2};
      go_to(Region::smooth, std::array<Plane, 1>{{main}});
      Vector &tau = result.stress;
      // What has passed sigma_1 = sigma_2 returns to that edge, unless it would
      // lie on its extension beyond the apex; likewise sigma_2 = sigma_3.
      const bool beyond_12 = tau[1] > tau[0], beyond_23 = tau[2] > tau[1];
      bool       found = !beyond_12 && !beyond_23;
      if (beyond_12)
        {
          go_to(Region::extension_edge, std::array<Plane, 2>{{main, {1, 2}}});
          tau[1] = tau[0];
          found  = tau[2] <= tau[1];
        }
      if (!found && beyond_23)
        {
          go_to(Region::compression_edge, std::array<Plane, 2>{{main, {0, 1}}});
          tau[2] = tau[1];
          found  = tau[1] <= tau[0];
        }
      if (!found)
        {
          result.region = Region::apex;
          tau.fill(resistance / (2 * sin_friction));
          for (auto &row : result.tangent)
            row.fill(0);
        }
      set_secants(2 * moduli.mu, strain, result);
      reorder(order, result);
    }
  } // namespace Materials
} // namespace Impoint
