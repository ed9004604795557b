#ifndef impoint_measurements_impulse_h
#define impoint_measurements_impulse_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Integral over time of a boundary's force on the material, by the
     * trapezoidal rule. The force at the start is that of the initial balance
     * in a dynamic run, so that the impulse of all boundaries and loads is the
     * change of momentum; in a quasi-static one a wall has none yet.
     *
     * Results: "NAME I_x", "NAME I_y"(, "NAME I_z") [Ns].
     */
    template <int dim>
    class Impulse : public NamedValues<dim>
    {
    public:
      Impulse(const ParameterFile         &file,
              const MeasurementParameters &parameters);

      bool integrates_forces() const override
      {
        return true;
      }
      void begin(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;
      void save_or_load(StateArchive &archive) override;

    private:
      const std::string boundary;
      Tensor<1, dim>    last_force, impulse;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
