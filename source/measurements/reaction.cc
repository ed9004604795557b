#include <impoint/base/parameter_file.h>
#include <impoint/measurements/reaction.h>
#include <impoint/measurements/totals.h>

#include <algorithm>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    Reaction<dim>::Reaction(const ParameterFile         &file,
                            const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, with_moments<dim>("F", "M"))
      , boundary(parameters.boundary)
      , centre(to_vector<dim>(parameters.point))
    {}



    template <int dim>
    void Reaction<dim>::check(const ParameterFile         &file,
                              const MeasurementParameters &parameters)
    {
      const auto boundaries = file.names("Boundaries/Names");
      if (std::count(boundaries.begin(), boundaries.end(), parameters.name) > 0)
        throw file.error("Measurements/Names",
                         "the reaction '" + parameters.name +
                           "' has a boundary's name",
                         "Give it another one: history.csv has columns '" +
                           parameters.name + " F_x' of the boundary already.");
    }



    template <int dim>
    void Reaction<dim>::end_step(const State<dim> &state)
    {
      const auto        &reaction = force_of(state, boundary);
      const Tensor<1, 3> about =
        reaction.moment - moment(centre, reaction.force);
      std::vector<double> values(reaction.force.begin_raw(),
                                 reaction.force.end_raw());
      for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
        values.push_back(about[d]);
      this->set(values, state.time);
    }



    template <int dim>
    const BoundaryForce<dim> &force_of(const State<dim>  &state,
                                       const std::string &boundary)
    {
      for (const auto &force : state.forces)
        if (force.name == boundary)
          return force;
      AssertThrow(false, ExcMessage("No force of boundary '" + boundary + "'"));
      return state.forces.front();
    }

    template const BoundaryForce<2> &force_of(const State<2> &,
                                              const std::string &);
    template const BoundaryForce<3> &force_of(const State<3> &,
                                              const std::string &);
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Reaction<2>;
template class Impoint::Measurements::Reaction<3>;
