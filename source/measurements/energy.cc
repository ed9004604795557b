#include <impoint/measurements/energy.h>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    Energy<dim>::Energy(const ParameterFile         &file,
                        const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {"kinetic", "strain", "total"})
    {}



    template <int dim>
    void Energy<dim>::start(const State<dim> &state)
    {
      end_step(state);
    }



    template <int dim>
    void Energy<dim>::end_step(const State<dim> &state)
    {
      const Totals<dim> &sums = state.totals;
      this->set({sums.kinetic_energy,
                 sums.strain_energy,
                 sums.kinetic_energy + sums.strain_energy},
                state.time);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Energy<2>;
template class Impoint::Measurements::Energy<3>;
