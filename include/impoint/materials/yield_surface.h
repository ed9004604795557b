#ifndef impoint_materials_yield_surface_h
#define impoint_materials_yield_surface_h

#include <impoint/materials/elastic_moduli.h>

#include <array>

namespace Impoint
{
  namespace Materials
  {
    /** The answer of a yield surface to a trial state, in principal axes, in
     * the order of the trial strains. */
    struct PrincipalReturn
    {
      enum class Region
      {
        elastic,
        smooth,
        extension_edge,   // sigma_1 = sigma_2
        compression_edge, // sigma_2 = sigma_3
        apex
      };

      Region region = Region::elastic;

      std::array<double, 3> stress; // Kirchhoff [Pa]

      /** Derivative of stress[a] with respect to trial strain b. */
      std::array<std::array<double, 3>, 3> tangent;

      /** (stress_a - stress_b) / (strain_a - strain_b) for the pairs 01, 02,
       * 12, or its limit where the strains are equal: the resistance to a turn
       * of the axes, which a quotient of round-off would not give. */
      std::array<double, 3> secant;
    };

    /** Where a pair of axes stands in PrincipalReturn::secant. */
    constexpr int pair_of(const int a, const int b)
    {
      return a + b - 1;
    }

    /**
     * An isotropic yield surface and its return mapping: linear elasticity
     * between principal Kirchhoff stresses and principal logarithmic strains.
     */
    class YieldSurface
    {
    public:
      explicit YieldSurface(const ElasticModuli &moduli)
        : moduli(moduli)
      {}

      virtual ~YieldSurface() = default;

      /** Whether plastic strains are normal to the surface. */
      virtual bool associated() const = 0;

      /**
       * Stress and tangents for elastic trial strains (in any order).
       * @p strength is the part of cohesion or yield stress that is left.
       */
      virtual void return_map(const std::array<double, 3> &trial_strain,
                              const double                 strength,
                              PrincipalReturn             &result) const = 0;

    protected:
      const ElasticModuli moduli;
    };

    /** The elastic answer. Surfaces alter it where it is beyond them. */
    void elastic_trial(const ElasticModuli         &moduli,
                       const std::array<double, 3> &trial_strain,
                       PrincipalReturn             &result);

    /** Strains of elastic stresses. */
    std::array<double, 3> elastic_strain(const ElasticModuli         &moduli,
                                         const std::array<double, 3> &stress);

    /** A trial state beyond the surface by less is on it: the round-off of
     * strains of this size, as a stress [Pa]. */
    double yield_tolerance(const ElasticModuli         &moduli,
                           const std::array<double, 3> &strain);
  } // namespace Materials
} // namespace Impoint

#endif
