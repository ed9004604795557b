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
      /** Angle [degrees] of the line that fits @p heights in the middle of
       * strips of the same width, where they are not -max. */
      double fitted_angle(const std::vector<double> &heights,
                          const double               width)
      {
        double n = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;
        for (unsigned int i = 0; i < heights.size(); ++i)
          if (heights[i] > std::numeric_limits<double>::lowest())
            {
              // Welford's updates
              const double x = i * width - mean_x, y = heights[i] - mean_y;
              n += 1;
              mean_x += x / n;
              mean_y += y / n;
              xx += x * (i * width - mean_x);
              xy += x * (heights[i] - mean_y);
            }
        return xx > 0 ? std::atan(xy / xx) * 180 / numbers::PI : 0.;
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
          const Tensor<1, 3> axis = parameters.axis.empty() ?
                                      Tensor<1, 3>({0, 0, 1}) :
                                      to_vector<3>(parameters.axis);
          up                      = cross_product_3d(axis, direction);
          up /= up.norm();
        }
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
      double         upper  = std::numeric_limits<double>::lowest();
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
      const double        width = half / n;
      std::vector<double> heights(n, std::numeric_limits<double>::lowest());
      for (unsigned int p = 0; p < points.n(); ++p)
        if (is_in_body(points, p, body))
          {
            const auto [x, y]  = place(points.position(p));
            const double strip = (x - first) / width;
            if (strip >= 0 && strip < n)
              heights[unsigned(strip)] = std::max(heights[unsigned(strip)], y);
          }
      Utilities::MPI::max(heights, comm, heights);
      this->set({fitted_angle(heights, width)}, state.time);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::SurfaceSlope<2>;
template class Impoint::Measurements::SurfaceSlope<3>;
