#ifndef impoint_measurements_condition_h
#define impoint_measurements_condition_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Condition number of the matrix that a step was solved with last: what a
     * cut, a penalty, a sliver do to it, and what of that the scale of the
     * unknowns is. Enters the history, and the results as it was last.
     */
    template <int dim>
    class Condition : public NamedValues<dim>
    {
    public:
      Condition(const ParameterFile         &file,
                const MeasurementParameters &parameters);

      void follow(const State<dim>                                 &state,
                  const LinearAlgebra::distributed::Vector<double> &u) override;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
