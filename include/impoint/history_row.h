#ifndef impoint_history_row_h
#define impoint_history_row_h

#include <impoint/base/counters.h>
#include <impoint/measurements/measurement.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** The row of history.csv for the step that @p state describes, which took
   * that many linear iterations. Collective. */
  template <int dim>
  HistoryRow
  history_row(const Measurements::State<dim> &state,
              const Counters                 &counters,
              const std::size_t               linear_iterations,
              const std::vector<std::unique_ptr<Measurements::Measurement<dim>>>
                &measurements);
} // namespace Impoint

#endif
