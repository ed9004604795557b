#include <impoint/materials/mohr_coulomb.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Impoint
{
  namespace Materials
  {
    using namespace dealii;

    namespace
    {
      using Vector = std::array<double, 3>;
      using Region = PrincipalReturn::Region;

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



    MohrCoulomb::MohrCoulomb(const ElasticModuli &moduli,
                             const double         cohesion,
                             const double         friction,
                             const double         dilation)
      : YieldSurface(moduli)
      , cohesion(cohesion)
      , sin_friction(std::sin(friction * numbers::PI / 180))
      , cos_friction(std::cos(friction * numbers::PI / 180))
      , sin_dilation(std::sin(dilation * numbers::PI / 180))
      , to_plane(way_to<1>({{{0, 2}}}))
      , to_extension_edge(way_to<2>({{{0, 2}, {1, 2}}}))
      , to_compression_edge(way_to<2>({{{0, 2}, {0, 1}}}))
    {
      Assert(cohesion > 0 || friction > 0,
             ExcMessage("Neither friction nor cohesion."));
    }



    // Koiter's rule: tau = tau_trial - D b_j G^-1_ji f_i with G_ij = a_i . D
    // b_j. All but f_i is the same for all states.
    template <int n>
    MohrCoulomb::Way
    MohrCoulomb::way_to(const std::array<Plane, n> &planes) const
    {
      const auto gradient = [](const Plane &plane, const double sine) {
        Vector a       = {};
        a[plane.major] = 1 + sine;
        a[plane.minor] = sine - 1;
        return a;
      };
      Way                   way = {};
      std::array<Vector, n> a, D_b;
      for (int i = 0; i < n; ++i)
        {
          a[i]   = gradient(planes[i], sin_friction);
          D_b[i] = elastic_product(moduli, gradient(planes[i], sin_dilation));
          way.gradients[i] = a[i];
        }
      const auto inverse = inverse_moduli<n>(a, D_b);

      way.n = n;
      for (int k = 0; k < 3; ++k)
        {
          way.tangent[k].fill(moduli.lambda);
          way.tangent[k][k] += 2 * moduli.mu;
        }
      for (int i = 0; i < n; ++i)
        {
          const Vector D_a = elastic_product(moduli, a[i]);
          for (int k = 0; k < 3; ++k)
            {
              for (int j = 0; j < n; ++j)
                way.ways[i][k] += D_b[j][k] * inverse[j][i];
              for (int l = 0; l < 3; ++l)
                way.tangent[k][l] -= way.ways[i][k] * D_a[l];
            }
        }
      return way;
    }



    void MohrCoulomb::go(const Way    &way,
                         const double  resistance,
                         const Vector &trial,
                         Vector       &stress)
    {
      stress = trial;
      for (int i = 0; i < way.n; ++i)
        {
          const double excess = dot(way.gradients[i], trial) - resistance;
          for (int k = 0; k < 3; ++k)
            stress[k] -= way.ways[i][k] * excess;
        }
    }



    double MohrCoulomb::yield_function(const Vector &stress,
                                       const double  strength) const
    {
      const double largest =
        std::max(std::max(stress[0], stress[1]), stress[2]);
      const double smallest =
        std::min(std::min(stress[0], stress[1]), stress[2]);
      return (1 + sin_friction) * largest - (1 - sin_friction) * smallest -
             2 * strength * cohesion * cos_friction;
    }



    namespace
    {
      /** Axes in descending order of their values. */
      std::array<int, 3> descending(const Vector &values)
      {
        std::array<int, 3> order = {{0, 1, 2}};
        for (const int k : {0, 1, 0})
          if (values[order[k]] < values[order[k + 1]])
            std::swap(order[k], order[k + 1]);
        return order;
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
      void reorder(const std::array<int, 3> &order,
                   const PrincipalReturn    &sorted,
                   PrincipalReturn          &result)
      {
        result.region = sorted.region;
        for (int a = 0; a < 3; ++a)
          {
            result.stress[order[a]] = sorted.stress[a];
            for (int b = 0; b < 3; ++b)
              result.tangent[order[a]][order[b]] = sorted.tangent[a][b];
            for (int b = a + 1; b < 3; ++b)
              result.secant[pair_of(order[a], order[b])] =
                sorted.secant[pair_of(a, b)];
          }
      }
    } // namespace



    void MohrCoulomb::return_map(const Vector    &trial_strain,
                                 const double     strength,
                                 PrincipalReturn &result) const
    {
      const Vector elastic = elastic_product(moduli, trial_strain);
      if (yield_function(elastic, strength) <=
          yield_tolerance(moduli, trial_strain))
        return elastic_trial(moduli, trial_strain, result);

      const auto order = descending(trial_strain);
      Vector     strain, trial;
      for (int a = 0; a < 3; ++a)
        {
          strain[a] = trial_strain[order[a]];
          trial[a]  = elastic[order[a]];
        }

      const double    resistance = 2 * strength * cohesion * cos_friction;
      PrincipalReturn sorted;
      Vector         &tau = sorted.stress;
      const Way      *way = &to_plane;
      sorted.region       = Region::smooth;
      go(to_plane, resistance, trial, tau);
      // What has passed sigma_1 = sigma_2 returns to that edge, unless it would
      // lie on its extension beyond the apex; likewise sigma_2 = sigma_3.
      const bool beyond_12 = tau[1] > tau[0], beyond_23 = tau[2] > tau[1];
      bool       found = !beyond_12 && !beyond_23;
      if (beyond_12)
        {
          way           = &to_extension_edge;
          sorted.region = Region::extension_edge;
          go(to_extension_edge, resistance, trial, tau);
          tau[1] = tau[0];
          found  = tau[2] <= tau[1];
        }
      if (!found && beyond_23)
        {
          way           = &to_compression_edge;
          sorted.region = Region::compression_edge;
          go(to_compression_edge, resistance, trial, tau);
          tau[2] = tau[1];
          found  = tau[1] <= tau[0];
        }
      if (found)
        sorted.tangent = way->tangent;
      else
        {
          sorted.region = Region::apex;
          tau.fill(resistance / (2 * sin_friction));
          for (auto &row : sorted.tangent)
            row.fill(0);
        }
      set_secants(2 * moduli.mu, strain, sorted);
      reorder(order, sorted, result);
    }
  } // namespace Materials
} // namespace Impoint
