#ifndef impoint_measurements_energy_h
#define impoint_measurements_energy_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Energies of all material points.
     *
     * Results: "NAME kinetic", "NAME strain", "NAME total" (their sum) [J]; NaN
     * where a material has no strain energy.
     */
    template <int dim>
    class Energy : public NamedValues<dim>
    {
    public:
      Energy(const ParameterFile         &file,
             const MeasurementParameters &parameters);

      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
