#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/output/summary.h>
#include <impoint/simulation.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Impoint
{
  template <int dim>
  void Simulation<dim>::run()
  {
    try
      {
        begin();
        const StopSignals signals;
        step_through(signals);
      }
    catch (const InputError &) // nothing was computed
      {
        throw;
      }
    catch (const std::exception &failure)
      {
        fail(failure);
        throw;
      }
    end("done", "");
  }



  /** Keeps what there is, as far as the disk takes it. */
  template <int dim>
  void Simulation<dim>::fail(const std::exception &failure)
  {
    // What follows is collective.
    if (!all_ranks_arrive(*failures))
      return;
    const bool stopped = dynamic_cast<const RunStopped *>(&failure);
    const bool said    = dynamic_cast<const RunFailed *>(&failure);
    if (!stopped)
      u.reinit(0); // of a step that failed
    try
      {
        keep_last_good_state();
        end(stopped ? "stopped" : "failed",
            said ? failure.what() : "an error inside impoint or a library");
      }
    catch (const RunFailed &further)
      {
        terminal.warning(further.what());
      }
  }



  template <int dim>
  void Simulation<dim>::begin()
  {
    if (!resumed)
      {
        ScopedSeconds timer(seconds.output);
        folder.create();
        folder.write("parameters.prm", used_parameters);
      }
    history.begin(columns, counters.steps);
    activate(time, time + step_size.size);
    // A run that had come to its end counts no pattern of a step that follows.
    if (resumed && scene.time.is_over(time))
      counters.patterns = patterns_before;
    ScopedSeconds timer(seconds.output);
    fill_record();
    terminal.header(run_record);
    if (resumed)
      {
        std::ostringstream text;
        text << "goes on after step " << counters.steps << " at time " << time
             << " s";
        terminal.message(text.str());
      }
    else
      picture();
  }



  template <int dim>
  RunStopped Simulation<dim>::told_to_stop() const
  {
    return RunStopped("The run was told to stop by a signal, after step " +
                      std::to_string(counters.steps) + "; 'impoint --resume " +
                      folder.path() + "' goes on");
  }



  /** Steps of the given size to the end; halved where one fails, and doubled
   * again after two that did not. */
  template <int dim>
  void Simulation<dim>::step_through(const StopSignals &signals)
  {
    const double given = scene.time.step;
    const double end   = scene.time.end;
    while (!scene.time.is_over(time))
      {
        // The last one ends at the end; what is left by round-off is no step.
        const bool   rests = scene.time.rests_after(time);
        const double left  = (rests ? scene.time.dynamic_from : end) - time;
        const double now =
          left < step_size.size * (1. + 1e-9) ? left : step_size.size;
        try
          {
            advance(now);
          }
        catch (const StepFailed &failure)
          {
            if (!is_whole) // amid an update: there is nothing to repeat
              throw RunFailed(failure.what());
            u.reinit(0);
            halve(now, failure);
            if (Utilities::MPI::max(int(signals.arrived()), comm))
              throw told_to_stop();
            continue;
          }
        if (++step_size.n_good >= 2 && step_size.size < given)
          step_size = {std::min(2. * step_size.size, given), 0};

        bool stop = signals.arrived();
        checkpoint(stop);
        if (stop && !scene.time.is_over(time))
          throw told_to_stop();
      }
  }



  template <int dim>
  void Simulation<dim>::halve(const double failed, const StepFailed &failure)
  {
    std::string reason = failure.what();
    reason.erase(reason.find_last_not_of(". ") + 1);
    const std::string text = of_step(failed) + reason;
    if (constant_load)
      throw RunFailed(text +
                      ". Smaller steps would not help: no load depends on t. "
                      "Let it grow with time, e.g. Body force = 0; -9.81 * t");
    ++counters.halved_steps;
    stored_step.reset(); // with another size of the next step
    step_size = {0.5 * failed, 0};
    if (step_size.size < scene.time.smallest * scene.time.step ||
        time + step_size.size == time)
      {
        step_size = {scene.time.step, 0}; // of a run that goes on from here
        throw RunFailed(text +
                        ". Steps were halved down to the smallest ('Smallest "
                        "step' in section 'Time')");
      }
    terminal.detail(text + "; halved");
  }



  /** What a message on the next step, of length @p dt, begins with. */
  template <int dim>
  std::string Simulation<dim>::of_step(const double dt) const
  {
    std::ostringstream text;
    text << "step " << counters.steps + 1 << " at time " << time
         << " s with a step of " << dt << " s: ";
    return text.str();
  }



  /** Writes a checkpoint if one is due; sets @p stop if any rank was told to
   * stop. A resumed run has no factor of earlier steps. That it goes on with
   * the same digits, the running one forgets its own there, too: at steps that
   * its course alone decides on, not the clock. What the clock asks for is
   * written at the next of these. Collective. */
  template <int dim>
  void Simulation<dim>::checkpoint(bool &stop)
  {
    constexpr std::size_t enough  = 100; // a new factor costs little beside
    const auto           &output  = scene.output;
    const double          minutes = seconds_since(last_checkpoint) / 60.;
    const int             in_time = minutes >= output.checkpoint_minutes;
    // A run that stops writes one anyway.
    const int told = Utilities::MPI::max(stop ? 2 : in_time, comm);
    stop           = told == 2;

    const bool by_steps = output.checkpoint_every > 0 &&
                          counters.steps % output.checkpoint_every == 0;
    solver_starts_anew =
      by_steps || (output.checkpoint_minutes > 0 &&
                   counters.residuals - residuals_before >= enough);
    if (!solver_starts_anew)
      return;
    residuals_before = counters.residuals;
    if (by_steps || told == 1)
      write_checkpoint();
  }



  /** A checkpoint and pictures of a run that fails, unless there are some of
   * this step or it fails amid an update. The pictures come last: a run that
   * goes on from the checkpoint replaces them by its own. */
  template <int dim>
  void Simulation<dim>::keep_last_good_state()
  {
    try
      {
        if (!is_whole)
          return;
        if (stored_step != counters.steps)
          write_checkpoint();
        if (pictured_step != counters.steps)
          picture();
      }
    catch (const RunFailed &failure)
      {
        warn(failure.what());
      }
  }



  template <int dim>
  void Simulation<dim>::end(const std::string &status,
                            const std::string &message)
  {
    seconds.total = earlier_seconds + seconds_since(start_of_run);
    fill_record();
    run_record.status  = status;
    run_record.message = message;
    run_record.results.clear();
    // Before the first step nothing has been measured.
    if (counters.steps > 0)
      for (const auto &measurement : measurements)
        measurement->results(run_record.results);
    const auto none = std::numeric_limits<double>::quiet_NaN();
    for (auto &result : run_record.results)
      {
        if (!result.warning.empty())
          warn(result.warning);
        // References are those of the end.
        if (status != "done")
          result.reference = none;
      }
    write_summary(run_record, folder);
    terminal.finish(run_record, folder.path());
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
