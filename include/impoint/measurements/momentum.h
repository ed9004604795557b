#ifndef impoint_measurements_momentum_h
#define impoint_measurements_momentum_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Momentum of all material points and their angular momentum about a point
     * that stands still. Dynamic scenes only.
     *
     * Results: "NAME p_x", "NAME p_y"(, "NAME p_z") [kg m/s]; "NAME L_z", in 3D
     * "NAME L_x" and "NAME L_y", too [kg m2/s].
     */
    template <int dim>
    class Momentum : public NamedValues<dim>
    {
    public:
      Momentum(const ParameterFile         &file,
               const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;

    private:
      const Tensor<1, dim> centre;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
