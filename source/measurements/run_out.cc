#include <impoint/measurements/run_out.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    RunOut<dim>::RunOut(const ParameterFile         &file,
                        const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {"furthest", "99 %"})
      , body(body_number(file, parameters))
      , direction(to_vector<dim>(parameters.direction))
    {
      direction /= direction.norm();
    }



    template <int dim>
    void RunOut<dim>::start(const State<dim> &state)
    {
      end_step(state);
    }



    template <int dim>
    void RunOut<dim>::end_step(const State<dim> &state)
    {
      const MPI_Comm comm   = state.active.basis().grid().communicator();
      const auto    &points = state.points;
      Row            row;
      double         lower = std::numeric_limits<double>::max();
      double         upper = std::numeric_limits<double>::lowest();
      for (unsigned int p = 0; p < points.n(); ++p)
        if (is_in_body(points, p, body))
          {
            const double coordinate = points.position(p) * direction;
            row.coordinates.push_back(coordinate);
            row.masses.push_back(points.data(p)[points.slots().mass]);
            lower = std::min(lower, coordinate);
            upper = std::max(upper, coordinate);
          }
      lower = Utilities::MPI::min(lower, comm);
      upper = Utilities::MPI::max(upper, comm);
      this->set({upper, quantile(row, lower, upper, 0.99, comm)}, state.time);
    }



    // Each pass zooms into the bin in which the share is reached. Masses are
    // compared with a margin, so that the order of their sum, which depends on
    // the number of ranks, does not decide between two points.
    template <int dim>
    double RunOut<dim>::quantile(const Row     &row,
                                 double         lower,
                                 double         upper,
                                 const double   share,
                                 const MPI_Comm communicator)
    {
      const unsigned int n_bins = 1000, n_passes = 4;
      double             below = 0, wanted = 0;
      for (unsigned int pass = 0; pass < n_passes && upper > lower; ++pass)
        {
          const double        width = (upper - lower) / n_bins;
          std::vector<double> bins(n_bins, 0.);
          for (unsigned int i = 0; i < row.masses.size(); ++i)
            {
              const double place = (row.coordinates[i] - lower) / width;
              if (place >= 0 && place <= n_bins)
                bins[std::min<unsigned int>(place, n_bins - 1)] +=
                  row.masses[i];
            }
          sum_over_ranks(bins, communicator);
          if (pass == 0)
            for (const double mass : bins)
              wanted += (share - 1e-9) * mass;

          unsigned int bin = 0;
          for (; bin < n_bins - 1 && below + bins[bin] < wanted; ++bin)
            below += bins[bin];
          lower += bin * width;
          upper = lower + width;
        }
      return upper;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::RunOut<2>;
template class Impoint::Measurements::RunOut<3>;
