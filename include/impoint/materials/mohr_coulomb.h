#ifndef impoint_materials_mohr_coulomb_h
#define impoint_materials_mohr_coulomb_h

#include <impoint/materials/yield_surface.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * Mohr-Coulomb's surface, for sigma_1 >= sigma_2 >= sigma_3 (tension
     * positive) f = (1 + sin phi) sigma_1 - (1 - sin phi) sigma_3 - 2 c cos
     * phi, with plastic flow of the same form with the dilation angle psi.
     *
     * The return is exact, for in principal stresses all is linear: to a plane,
     * to one of the two edges beside it, or to the apex (J. Clausen, L.
     * Damkilde, L. Andersen, An efficient return algorithm for non-associated
     * plasticity with linear yield criteria in principal stress space,
     * Computers & Structures 85, 2007). Without cohesion the apex is the state
     * without stress.
     */
    class MohrCoulomb : public YieldSurface
    {
    public:
      /** Angles in degrees, 0 <= @p dilation <= @p friction < 90;
       * @p cohesion >= 0 [Pa], above 0 if there is no friction. */
      MohrCoulomb(const ElasticModuli &moduli,
                  const double         cohesion,
                  const double         friction,
                  const double         dilation);

      bool associated() const override
      {
        return sin_friction == sin_dilation;
      }

      void return_map(const std::array<double, 3> &trial_strain,
                      const double                 strength,
                      PrincipalReturn             &result) const override;

      /** Value of the yield function [Pa]. */
      double yield_function(const std::array<double, 3> &stress,
                            const double                 strength) const;

    private:
      using Vector = std::array<double, 3>;

      /** A plane of the surface or its potential, of stresses in descending
       * order: it grows with that of one axis and falls with that of another.
       */
      struct Plane
      {
        int major, minor;
      };

      /** The way back to where n planes f_i = a_i . tau - 2 c cos phi meet. */
      struct Way
      {
        int                   n;
        std::array<Vector, 2> gradients; // a_i
        std::array<Vector, 2> ways;      // what each f_i takes from the stress
        std::array<Vector, 3> tangent;
      };

      template <int n>
      Way way_to(const std::array<Plane, n> &planes) const;

      static void go(const Way    &way,
                     const double  resistance,
                     const Vector &trial,
                     Vector       &stress);

      const double cohesion;
      const double sin_friction, cos_friction, sin_dilation;
      const Way    to_plane, to_extension_edge, to_compression_edge;
    };
  } // namespace Materials
} // namespace Impoint

#endif
