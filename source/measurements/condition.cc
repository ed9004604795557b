#include <impoint/measurements/condition.h>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    Condition<dim>::Condition(const ParameterFile         &file,
                              const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {"", "scaled"})
    {}



    template <int dim>
    void Condition<dim>::follow(
      const State<dim> &state,
      const LinearAlgebra::distributed::Vector<double> & /*u*/)
    {
      const ConditionNumbers numbers = state.condition_numbers();
      this->set({numbers.whole, numbers.scaled}, state.time);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Condition<2>;
template class Impoint::Measurements::Condition<3>;
