#ifndef impoint_simulation_h
#define impoint_simulation_h

#include <impoint/base/command_line.h>
#include <impoint/base/stop_signals.h>
#include <impoint/checkpoint_schedule.h>
#include <impoint/output/checkpoint_file.h>
#include <impoint/report.h>
#include <impoint/stepper.h>

#include <string>

namespace Impoint
{
  /** Size of the next step: halved where one fails, and doubled again after two
   * that did not. */
  struct StepSize
  {
    double       size   = 0; // [s]
    unsigned int n_good = 0; // steps since it last changed
  };

  /**
   * A run of a scene from its parameters to its results: steps of the Stepper
   * under the eyes of the Report, shorter where they fail, and checkpoints
   * between them.
   */
  template <int dim>
  class Simulation
  {
  public:
    /** Builds grid, particles and boundaries, or takes up those of the newest
     * checkpoint; computes and writes nothing. Throws InputError for what only
     * they reveal. */
    Simulation(ParameterFile    &file,
               const Scene<dim> &scene,
               const RunOptions &options,
               const MPI_Comm    communicator);

    /** Runs to the end. Throws RunFailed where it cannot go on; the last good
     * state is on disk then. */
    void run();

  private:
    void       begin();
    void       step_through(const StopSignals &signals);
    RunStopped told_to_stop() const;
    void       halve(const double failed, const StepFailed &failure);
    void       end(const std::string &status, const std::string &message);
    void       fail(const std::exception &failure);
    void       keep_last_good_state();
    void       checkpoint(bool &stop);
    void       write_checkpoint();
    void       save_or_load(StateArchive &archive);
    void       resume(StoredState stored);

    const std::chrono::steady_clock::time_point start_of_run;
    MPI_Comm                                    comm;
    Utilities::MPI::DuplicatedCommunicator      failures;
    ParameterFile                              &file;
    const Scene<dim>                           &scene;
    const bool                                  resumed;
    const std::string                           used_parameters;
    Counters                                    counters;
    Seconds                                     seconds;

    OutputFolder       folder;
    Report<dim>        report;
    Stepper<dim>       stepper;
    CheckpointSchedule checkpoints;

    const bool  constant_load;
    StepSize    step_size;
    std::size_t patterns_before = 0; // the resumed run
    double      earlier_seconds = 0; // of it
  };
} // namespace Impoint

#endif
