#include <impoint/base/on_all_ranks.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/simulation.h>

#include <algorithm>
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
      stepper.forget_displacements(); // of a step that failed
    try
      {
        keep_last_good_state();
        end(stopped ? "stopped" : "failed",
            said ? failure.what() : "an error inside impoint or a library");
      }
    catch (const RunFailed &further)
      {
        report.terminal().warning(further.what());
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
    report.open();
    stepper.activate(step_size.size);
    // A run that had come to its end counts no pattern of a step that follows.
    if (resumed && scene.time.is_over(stepper.time()))
      counters.patterns = patterns_before;
    ScopedSeconds timer(seconds.output);
    report.header(stepper.state(), stepper.solver_description());
    if (resumed)
      {
        std::ostringstream text;
        text << "goes on after step " << counters.steps << " at time "
             << stepper.time() << " s";
        report.terminal().message(text.str());
      }
    else
      report.picture(stepper.state(), stepper.displacements());
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
    while (!scene.time.is_over(stepper.time()))
      {
        const double time = stepper.time();
        // The last one ends at the end; what is left by round-off is no step.
        const bool   rests = scene.time.rests_after(time);
        const double left  = (rests ? scene.time.dynamic_from : end) - time;
        const double now =
          left < step_size.size * (1. + 1e-9) ? left : step_size.size;
        try
          {
            stepper.advance(now, report);
          }
        catch (const StepFailed &failure)
          {
            if (!stepper
                   .is_whole()) // amid an update: there is nothing to repeat
              throw RunFailed(failure.what());
            stepper.forget_displacements();
            halve(now, failure);
            if (Utilities::MPI::max(int(signals.arrived()), comm))
              throw told_to_stop();
            continue;
          }
        if (++step_size.n_good >= 2 && step_size.size < given)
          step_size = {std::min(2. * step_size.size, given), 0};

        bool stop = signals.arrived();
        checkpoint(stop);
        if (stop && !scene.time.is_over(stepper.time()))
          throw told_to_stop();
      }
  }



  template <int dim>
  void Simulation<dim>::halve(const double failed, const StepFailed &failure)
  {
    std::string reason = failure.what();
    reason.erase(reason.find_last_not_of(". ") + 1);
    const std::string text = stepper.of_step(failed) + reason;
    if (constant_load)
      throw RunFailed(text +
                      ". Smaller steps would not help: no load depends on t. "
                      "Let it grow with time, e.g. Body force = 0; -9.81 * t");
    ++counters.halved_steps;
    checkpoints.outdate(); // with another size of the next step
    step_size = {0.5 * failed, 0};
    if (step_size.size < scene.time.smallest * scene.time.step ||
        stepper.time() + step_size.size == stepper.time())
      {
        step_size = {scene.time.step, 0}; // of a run that goes on from here
        throw RunFailed(text +
                        ". Steps were halved down to the smallest ('Smallest "
                        "step' in section 'Time')");
      }
    report.terminal().detail(text + "; halved");
  }



  /** A checkpoint and pictures of a run that fails, unless there are some of
   * this step or it fails amid an update. The pictures come last: a run that
   * goes on from the checkpoint replaces them by its own. */
  template <int dim>
  void Simulation<dim>::keep_last_good_state()
  {
    try
      {
        if (!stepper.is_whole())
          return;
        if (!checkpoints.is_stored())
          write_checkpoint();
        report.picture_if_missing(stepper.state(), stepper.displacements());
      }
    catch (const RunFailed &failure)
      {
        report.warn(failure.what());
      }
  }



  template <int dim>
  void Simulation<dim>::end(const std::string &status,
                            const std::string &message)
  {
    seconds.total = earlier_seconds + seconds_since(start_of_run);
    report.finish(stepper.state(),
                  stepper.solver_description(),
                  status,
                  message);
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
