#ifndef impoint_measurements_surface_slope_h
#define impoint_measurements_surface_slope_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Slope of a free surface, such as the angle of repose: of the straight
     * line that fits best to the highest points, found in strips as wide as a
     * cell, of the middle half of the material's extent in a direction.
     *
     * Results: "NAME" [degrees], positive where the surface rises in the
     * direction.
     */
    template <int dim>
    class SurfaceSlope : public NamedValues<dim>
    {
    public:
      SurfaceSlope(const ParameterFile         &file,
                   const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;

    private:
      /** The coordinates along the direction and upwards. */
      std::array<double, 2> place(const Point<dim> &x) const;

      const unsigned int body;
      Tensor<1, dim>     direction, up;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
