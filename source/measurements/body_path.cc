#include <impoint/measurements/body_path.h>
#include <impoint/measurements/totals.h>

#include <cmath>

namespace Impoint
{
  namespace Measurements
  {
    /** Mean displacement and mean place. */
    template <int dim>
    struct BodyPath<dim>::Centres
    {
      Tensor<1, dim> displacement, place;
    };



    template <int dim>
    BodyPath<dim>::BodyPath(const ParameterFile         &file,
                            const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {"path", "angle"})
      , body(body_number(file, parameters))
      , direction(to_vector<dim>(parameters.direction))
      , axis(parameters.axis.empty() ? Tensor<1, 3>({0., 0., 1.}) :
                                       to_vector<3>(parameters.axis))
    {
      direction /= direction.norm();
      axis /= axis.norm();
    }



    template <int dim>
    typename BodyPath<dim>::Centres
    BodyPath<dim>::centres(const State<dim> &state) const
    {
      const auto         &points = state.points;
      std::vector<double> sums(2 * dim + 1, 0.);
      for (unsigned int p = 0; p < points.n(); ++p)
        if (is_in_body(points, p, body))
          {
            const double *data = points.data(p);
            const double  mass = data[points.slots().mass];
            sums[2 * dim] += mass;
            for (unsigned int d = 0; d < dim; ++d)
              {
                sums[d] += mass * data[points.slots().u + d];
                sums[dim + d] += mass * data[points.slots().x + d];
              }
          }
      sum_over_ranks(sums, state.active.basis().grid().communicator());
      Centres result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.displacement[d] = sums[d] / sums[2 * dim];
          result.place[d]        = sums[dim + d] / sums[2 * dim];
        }
      return result;
    }



    template <int dim>
    double BodyPath<dim>::angle_now(const State<dim> &state,
                                    const Centres    &of_mass) const
    {
      const auto          &points = state.points;
      const Tensor<1, dim> axis_in_space =
        dim == 2 ? Tensor<1, dim>() :
                   to_vector<dim>({axis.begin_raw(), axis.end_raw()});
      std::vector<double> sums(2, 0.); // towards sine and cosine
      for (unsigned int p = 0; p < points.n(); ++p)
        if (is_in_body(points, p, body))
          {
            const double         mass = points.data(p)[points.slots().mass];
            const Tensor<1, dim> now =
              points.position(p) - Point<dim>(of_mass.place);
            const Tensor<1, dim> first =
              now - points.vector(p, points.slots().u) + of_mass.displacement;
            sums[0] += mass * (axis * moment(first, now));
            sums[1] += mass * (first * now -
                               (first * axis_in_space) * (now * axis_in_space));
          }
      sum_over_ranks(sums, state.active.basis().grid().communicator());
      return std::atan2(sums[0], sums[1]);
    }



    template <int dim>
    void BodyPath<dim>::end_step(const State<dim> &state)
    {
      const Centres of_mass = centres(state);
      angle +=
        std::remainder(angle_now(state, of_mass) - angle, 2 * numbers::PI);
      this->set({of_mass.displacement * direction, angle}, state.time);
    }



    template <int dim>
    void BodyPath<dim>::save_or_load(StateArchive &archive)
    {
      NamedValues<dim>::save_or_load(archive);
      archive &angle;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::BodyPath<2>;
template class Impoint::Measurements::BodyPath<3>;
