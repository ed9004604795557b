#ifndef impoint_materials_von_mises_h
#define impoint_materials_von_mises_h

#include <impoint/materials/yield_surface.h>

namespace Impoint
{
  namespace Materials
  {
    /** Von Mises' cylinder f = sqrt(3 J_2) - yield stress, with associated
     * flow: radial return. */
    class VonMises : public YieldSurface
    {
    public:
      /** @p yield_stress > 0 [Pa] in uniaxial stress. */
      VonMises(const ElasticModuli &moduli, const double yield_stress)
        : YieldSurface(moduli)
        , yield_stress(yield_stress)
      {}

      bool associated() const override
      {
        return true;
      }

      void return_map(const std::array<double, 3> &trial_strain,
                      const double                 strength,
                      PrincipalReturn             &result) const override;

    private:
      const double yield_stress;
    };
  } // namespace Materials
} // namespace Impoint

#endif
