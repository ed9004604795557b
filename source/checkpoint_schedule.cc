#include <impoint/base/scoped_seconds.h>
#include <impoint/checkpoint_schedule.h>

namespace Impoint
{
  CheckpointSchedule::CheckpointSchedule(const OutputParameters &parameters,
                                         const Counters         &counters)
    : parameters(parameters)
    , counters(counters)
    , last_time(std::chrono::steady_clock::now())
  {}



  bool CheckpointSchedule::clock_asks() const
  {
    return parameters.checkpoint_minutes > 0 &&
           seconds_since(last_time) >= 60. * parameters.checkpoint_minutes;
  }



  void CheckpointSchedule::end_step(const bool told_by_clock)
  {
    constexpr std::size_t enough   = 100; // a new factor costs little beside
    const bool            by_steps = parameters.checkpoint_every > 0 &&
                          counters.steps % parameters.checkpoint_every == 0;
    anew = by_steps || (parameters.checkpoint_minutes > 0 &&
                        counters.residuals - residuals_before >= enough);
    due  = by_steps || (anew && told_by_clock);
    if (anew)
      residuals_before = counters.residuals;
  }



  void CheckpointSchedule::stored()
  {
    stored_step      = counters.steps;
    residuals_before = counters.residuals;
    last_time        = std::chrono::steady_clock::now();
  }
} // namespace Impoint
