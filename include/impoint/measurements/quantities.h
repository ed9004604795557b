#ifndef impoint_measurements_quantities_h
#define impoint_measurements_quantities_h

#include <impoint/measurements/measurement.h>

#include <tuple>

namespace Impoint
{
  namespace Measurements
  {
    /** What a class of measurements can do before there is one. */
    template <int dim>
    struct QuantityFunctions
    {
      void (*check)(const ParameterFile         &file,
                    const MeasurementParameters &parameters);

      std::unique_ptr<Measurement<dim>> (*create)(
        const ParameterFile         &file,
        const MeasurementParameters &parameters);
    };

    /** What the entry 'Quantity' may be: a row of the table of measurements.
     * Entries, their help texts and messages follow from it. */
    struct Quantity
    {
      std::string              name;
      std::string              help;      // what is measured, and its unit
      std::vector<std::string> entries;   // those it looks at, beside all's
      std::string              reference; // the results, in their order

      bool uses(const std::string &entry) const;

      template <int dim>
      const QuantityFunctions<dim> &functions() const
      {
        return std::get<dim - 2>(of_dimension);
      }

      std::tuple<QuantityFunctions<2>, QuantityFunctions<3>> of_dimension;
    };

    const std::vector<Quantity> &quantities();

    const Quantity &quantity(const std::string &name);
  } // namespace Measurements
} // namespace Impoint

#endif
