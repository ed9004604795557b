#include <impoint/measurements/impulse.h>
#include <impoint/measurements/reaction.h>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    Impulse<dim>::Impulse(const ParameterFile         &file,
                          const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, with_components<dim>("I"))
      , boundary(parameters.boundary)
    {}



    template <int dim>
    void Impulse<dim>::begin(const State<dim> &state)
    {
      last_force = force_of(state, boundary).force;
    }



    template <int dim>
    void Impulse<dim>::end_step(const State<dim> &state)
    {
      const Tensor<1, dim> force = force_of(state, boundary).force;
      impulse += 0.5 * state.time_step * (last_force + force);
      last_force = force;
      this->set(std::vector<double>(impulse.begin_raw(), impulse.end_raw()),
                state.time);
    }



    template <int dim>
    void Impulse<dim>::save_or_load(StateArchive &archive)
    {
      NamedValues<dim>::save_or_load(archive);
      archive &last_force &impulse;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Impulse<2>;
template class Impoint::Measurements::Impulse<3>;
