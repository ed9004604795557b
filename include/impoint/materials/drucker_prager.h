#ifndef impoint_materials_drucker_prager_h
#define impoint_materials_drucker_prager_h

#include <impoint/materials/yield_surface.h>

namespace Impoint
{
  namespace Materials
  {
    /**
     * Drucker-Prager's cone f = sqrt(J_2) + eta p - xi c, p the mean stress
     * (tension positive), round the compression edges of Mohr-Coulomb's
     * surface: eta = 6 sin phi / (sqrt(3) (3 - sin phi)), xi = eta / tan phi;
     * plastic flow of the same form with the dilation angle psi.
     */
    class DruckerPrager : public YieldSurface
    {
    public:
      /** Angles in degrees, 0 <= @p dilation <= @p friction < 90;
       * @p cohesion >= 0 [Pa], above 0 if there is no friction. */
      DruckerPrager(const ElasticModuli &moduli,
                    const double         cohesion,
                    const double         friction,
                    const double         dilation);

      bool associated() const override
      {
        return eta == eta_dilation;
      }

      void return_map(const std::array<double, 3> &trial_strain,
                      const double                 strength,
                      PrincipalReturn             &result) const override;

      /** Value of the yield function [Pa]. */
      double yield_function(const std::array<double, 3> &stress,
                            const double                 strength) const;

    private:
      double eta, eta_dilation; // slope of cone and potential
      double resistance;        // xi c [Pa]
    };
  } // namespace Materials
} // namespace Impoint

#endif
