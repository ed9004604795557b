#include <impoint/measurements/convergence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Impoint
{
  namespace Measurements
  {
    double order_of_convergence(const std::vector<double> &residuals)
    {
      const auto end =
        std::find_if(residuals.begin(),
                     residuals.end(),
                     [](const double residual) { return residual < 1e-13; });
      if (end - residuals.begin() < 3 || end[-2] >= end[-3])
        return std::numeric_limits<double>::infinity();
      return std::log(end[-1] / end[-2]) / std::log(end[-2] / end[-3]);
    }



    template <int dim>
    Convergence<dim>::Convergence(const ParameterFile & /*file*/,
                                  const MeasurementParameters &parameters)
      : name(parameters.name)
      , smallest_order(std::numeric_limits<double>::infinity())
    {}



    template <int dim>
    void Convergence<dim>::end_step(const State<dim> &state)
    {
      iterations = state.residuals.empty() ? 0 : state.residuals.size() - 1;
      most_iterations = std::max(most_iterations, iterations);
      smallest_order =
        std::min(smallest_order, order_of_convergence(state.residuals));
    }



    template <int dim>
    void Convergence<dim>::columns(HistoryRow &row) const
    {
      row.emplace_back(name + " iterations", iterations);
    }



    template <int dim>
    void Convergence<dim>::results(std::vector<Result> &results) const
    {
      results.push_back({name + " iterations", double(most_iterations)});
      if (std::isfinite(smallest_order))
        results.push_back({name + " order", smallest_order});
    }



    template <int dim>
    void Convergence<dim>::save_or_load(StateArchive &archive)
    {
      archive.tag(name);
      archive &iterations &most_iterations &smallest_order;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Convergence<2>;
template class Impoint::Measurements::Convergence<3>;
