#ifndef impoint_measurements_body_path_h
#define impoint_measurements_body_path_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Way of the centre of mass along a direction, and the angle by which the
     * material has turned about an axis: that of the rotation R nearest to the
     * motion, which maximises sum m (x - c) . R (X - C). Whole turns count as
     * long as a step stays below half a turn.
     *
     * Results: "NAME path" [m], "NAME angle" [rad].
     */
    template <int dim>
    class BodyPath : public NamedValues<dim>
    {
    public:
      BodyPath(const ParameterFile         &file,
               const MeasurementParameters &parameters);

      void end_step(const State<dim> &state) override;
      void save_or_load(StateArchive &archive) override;

    private:
      struct Centres;

      Centres centres(const State<dim> &state) const;
      double  angle_now(const State<dim> &state, const Centres &of_mass) const;

      const unsigned int body;
      Tensor<1, dim>     direction;
      Tensor<1, 3>       axis;
      double             angle = 0;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
