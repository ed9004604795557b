#include <impoint/base/parameter_file.h>
#include <impoint/measurements/surface_slope.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      constexpr double none = std::numeric_limits<double>::lowest();

      /** Angle [degrees] of the line that fits best to @p places, but those
       * without a height. */
      double fitted_angle(const std::vector<double> &places,
                          const std::vector<double> &heights)
      {
        double n = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;
        for (unsigned int i = 0; i < heights.size(); ++i)
          if (heights[i] != none)
            {
              const double x = places[i] - mean_x, y = heights[i] - mean_y;
              n += 1;
              mean_x += x / n;
              mean_y += y / n;
              xx += x * (places[i] - mean_x);
              xy += x * (heights[i] - mean_y);
            }
        return xx > 0 ? std::atan(xy / xx) * 180 / numbers::PI : 0.;
      }



      /** The axis of the angle in 3D. */
      Tensor<1, 3> horizontal_axis(const MeasurementParameters &parameters)
      {
        return parameters.axis.empty() ? Tensor<1, 3>({0, 0, 1}) :
                                         to_vector<3>(parameters.axis);
      }
    } // namespace



    template <int dim>
    SurfaceSlope<dim>::SurfaceSlope(const ParameterFile         &file,
                                    const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {""})
      , body(body_number(file, parameters))
      , direction(to_vector<dim>(parameters.direction))
    {
      direction /= direction.norm();
      if constexpr (dim == 2)
        {
          up[0] = -direction[1];
          up[1] = direction[0];
        }
      else
        {
          up = cross_product_3d(horizontal_axis(parameters), direction);
          up /= up.norm();
        }
    }



    template <int dim>
    void SurfaceSlope<dim>::check(const ParameterFile         &file,
                                  const MeasurementParameters &parameters)
    {
      if constexpr (dim == 3)
        if (cross_product_3d(to_vector<3>(parameters.direction),
                             horizontal_axis(parameters))
              .norm() == 0)
          throw file.error(parameters.section + "/Axis",
                           "the direction of a slope is along its axis",
                           "Give the horizontal axis across the direction.");
    }



    template <int dim>
    void SurfaceSlope<dim>::start(const State<dim> &state)
    {
      end_step(state);
    }



    template <int dim>
    std::array<double, 2> SurfaceSlope<dim>::place(const Point<dim> &x) const
    {
      return {{x * direction, x * up}};
    }



    template <int dim>
    void SurfaceSlope<dim>::end_step(const State<dim> &state)
    {
      const auto    &grid   = state.active.basis().grid();
      const MPI_Comm comm   = grid.communicator();
      const auto    &points = state.points;
      double         lower  = std::numeric_limits<double>::max();
      double         upper  = none;
      for (unsigned int p = 0; p < points.n(); ++p)
        if (is_in_body(points, p, body))
          {
            const double x = place(points.position(p))[0];
            lower          = std::min(lower, x);
            upper          = std::max(upper, x);
          }
      lower = Utilities::MPI::min(lower, comm);
      upper = Utilities::MPI::max(upper, comm);

      const double first = lower + 0.25 * (upper - lower);
      const double half  = 0.5 * (upper - lower);
      const auto   n =
        std::max<unsigned int>(2, std::round(half / grid.smallest_size()));
      std::vector<double> heights(n, none), places(n, none);
      const auto          for_points = [&](const auto &function) {
        for (unsigned int p = 0; p < points.n(); ++p)
          if (is_in_body(points, p, body))
            {
              const auto [x, y]  = place(points.position(p));
              const double strip = (x - first) / half * n;
              if (strip >= 0 && strip < n)
                function(unsigned(strip), x, y);
            }
      };
      for_points([&](const unsigned int strip, const double, const double y) {
        heights[strip] = std::max(heights[strip], y);
      });
      Utilities::MPI::max(heights, comm, heights);
      for_points([&](const unsigned int strip, const double x, const double y) {
        if (y == heights[strip])
          places[strip] = std::max(places[strip], x);
      });
      Utilities::MPI::max(places, comm, places);
      this->set({fitted_angle(places, heights)}, state.time);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::SurfaceSlope<2>;
template class Impoint::Measurements::SurfaceSlope<3>;
