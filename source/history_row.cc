#include <impoint/history_row.h>

#include <string>

namespace Impoint
{
  template <int dim>
  HistoryRow
  history_row(const Measurements::State<dim> &state,
              const Counters                 &counters,
              const std::size_t               linear_iterations,
              const std::vector<std::unique_ptr<Measurements::Measurement<dim>>>
                &measurements)
  {
    const auto &totals = state.totals;
    HistoryRow  row;
    row.emplace_back("step", counters.steps);
    row.emplace_back("time", state.time);
    row.emplace_back("dt", state.time_step);
    row.emplace_back("Newton iterations", state.residuals.size() - 1);
    row.emplace_back("linear iterations", linear_iterations);
    row.emplace_back("residual", state.residuals.back());
    row.emplace_back("active cells", counters.visited_cells);
    row.emplace_back("points", state.points.n_global());
    row.emplace_back("kinetic energy", totals.kinetic_energy);
    row.emplace_back("strain energy", totals.strain_energy);
    row.emplace_back("mass", totals.mass);
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(std::string("centre ") + "xyz"[d], totals.centre[d]);
    for (const auto &force : state.forces)
      {
        for (unsigned int d = 0; d < dim; ++d)
          row.emplace_back(force.name + " F_" + "xyz"[d], force.force[d]);
        for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
          row.emplace_back(force.name + " M_" + "xyz"[d], force.moment[d]);
      }
    for (const auto &measurement : measurements)
      measurement->columns(row);
    return row;
  }

  template HistoryRow history_row(
    const Measurements::State<2> &,
    const Counters &,
    const std::size_t,
    const std::vector<std::unique_ptr<Measurements::Measurement<2>>> &);
  template HistoryRow history_row(
    const Measurements::State<3> &,
    const Counters &,
    const std::size_t,
    const std::vector<std::unique_ptr<Measurements::Measurement<3>>> &);
} // namespace Impoint
