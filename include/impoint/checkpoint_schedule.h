#ifndef impoint_checkpoint_schedule_h
#define impoint_checkpoint_schedule_h

#include <impoint/base/counters.h>
#include <impoint/scene.h>

#include <chrono>
#include <optional>

namespace Impoint
{
  /**
   * When a run writes checkpoints. A resumed run has no factor of earlier
   * steps. That it goes on with the same digits, the running one forgets its
   * own there, too: at steps that its course alone decides on, not the clock.
   * What the clock asks for is written at the next of these.
   */
  class CheckpointSchedule
  {
  public:
    CheckpointSchedule(const OutputParameters &parameters,
                       const Counters         &counters);

    /** To be asked once after each step; @p told_by_clock on any rank. */
    void end_step(const bool told_by_clock);

    /** Whether the clock asks for a checkpoint, on this rank. */
    bool clock_asks() const;

    /** Whether the next step must not know earlier ones' factors. */
    bool solver_starts_anew() const
    {
      return anew;
    }

    bool is_due() const
    {
      return due;
    }

    /** Whether the newest checkpoint is of the last step. */
    bool is_stored() const
    {
      return stored_step == counters.steps;
    }

    /** A checkpoint of the last step was written, or read. */
    void stored();

    /** The newest checkpoint is no longer what a run should go on from. */
    void outdate()
    {
      stored_step.reset();
    }

  private:
    const OutputParameters               &parameters;
    const Counters                       &counters;
    std::chrono::steady_clock::time_point last_time;
    std::size_t                residuals_before = 0; // when it last began anew
    std::optional<std::size_t> stored_step;
    bool                       anew = false, due = false;
  };
} // namespace Impoint

#endif
