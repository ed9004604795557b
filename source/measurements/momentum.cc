#include <impoint/base/parameter_file.h>
#include <impoint/measurements/momentum.h>
#include <impoint/measurements/totals.h>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    Momentum<dim>::Momentum(const ParameterFile         &file,
                            const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, with_moments<dim>("p", "L"))
      , centre(to_vector<dim>(parameters.point))
    {}



    template <int dim>
    void Momentum<dim>::check(const ParameterFile         &file,
                              const MeasurementParameters &parameters)
    {
      if (file.value("Time/Kind") == "quasi-static")
        throw file.error(parameters.section + "/Quantity",
                         "the scene is quasi-static and has no momentum",
                         "Measure something else, or make it dynamic.");
    }



    template <int dim>
    void Momentum<dim>::start(const State<dim> &state)
    {
      end_step(state);
    }



    template <int dim>
    void Momentum<dim>::end_step(const State<dim> &state)
    {
      const Totals<dim>  &sums = state.totals;
      const Tensor<1, 3>  spin = sums.spin - moment<dim>(centre, sums.momentum);
      std::vector<double> values(sums.momentum.begin_raw(),
                                 sums.momentum.end_raw());
      for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
        values.push_back(spin[d]);
      this->set(values, state.time);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Momentum<2>;
template class Impoint::Measurements::Momentum<3>;
