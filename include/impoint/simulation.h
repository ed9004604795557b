#ifndef impoint_simulation_h
#define impoint_simulation_h

#include <impoint/base/command_line.h>
#include <impoint/base/stop_signals.h>
#include <impoint/measurements/measurement.h>
#include <impoint/output/checkpoint_file.h>
#include <impoint/output/history.h>
#include <impoint/output/pictures.h>
#include <impoint/output/run_record.h>
#include <impoint/output/terminal.h>
#include <impoint/scene.h>
#include <impoint/solver/newton.h>
#include <impoint/terms/body_force.h>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

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
   * A run of a scene. The members are the modules in the order of the
   * computation; a step goes through them: activate, project, solve, move,
   * record.
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
    using Vector = LinearAlgebra::distributed::Vector<double>;

    void        check_boundaries();
    void        begin();
    void        step_through(const StopSignals &signals);
    void        fail(const std::exception &failure);
    std::string of_step(const double dt) const;
    RunStopped  told_to_stop() const;
    void        halve(const double failed, const StepFailed &failure);
    void        advance(const double dt);
    void        begin_step(const double dt, const double end);
    void        activate(const double start, const double end);
    void        find_new_places();
    void        commit(const double dt);
    void        start_motion(const double dt);
    void        sum_forces(
             const std::vector<Measurements::BoundaryForce<dim>> &held,
             const std::vector<Measurements::BoundaryForce<dim>> &nonconforming);
    void warn(const std::string &text);
    void warn_of_lost_loads();
    void record();
    void picture();
    void fill_record();
    bool has_moved() const;
    void checkpoint(bool &stop);
    void write_checkpoint();
    void save_or_load(StateArchive &archive);
    void resume(StoredState stored);
    void keep_last_good_state();
    void end(const std::string &status, const std::string &message);

    Measurements::State<dim> state() const;
    std::vector<std::string> names_of_columns() const;

    const std::chrono::steady_clock::time_point start_of_run;
    MPI_Comm                                    comm;
    Utilities::MPI::DuplicatedCommunicator      failures;
    ParameterFile                              &file;
    const Scene<dim>                           &scene;
    Counters                                    counters;
    Seconds                                     seconds;
    const std::string                           used_parameters;
    OutputFolder                                folder;
    Terminal                                    terminal;
    BackgroundGrid<dim>                         grid;
    Basis<dim>                                  basis;
    ActiveNodes<dim>                            active;
    std::vector<BodyLoad<dim>>                  body_loads;
    std::unique_ptr<MaterialPoints<dim>>        points;
    EndStates<dim>                              end_states;
    Enforcement::Conforming<dim>                conforming;
    typename NonlinearSystem<dim>::Methods      methods;
    Inertia<dim>                                inertia;
    std::unique_ptr<NonlinearSystem<dim>>       system;
    std::unique_ptr<Newton<dim>>                newton;
    std::vector<std::unique_ptr<Measurements::Measurement<dim>>> measurements;
    std::vector<std::string>                                     columns;
    HistoryWriter                                                history;
    Pictures<dim>                                                pictures;

    double   time = 0, last_step = 0;
    StepSize step_size;
    bool     points_changed_cells = true;
    bool     solver_starts_anew   = false;
    bool is_whole = true; // state of one time, not in the middle of an update
    const bool  resumed, constant_load;
    std::size_t linear_iterations_before = 0;     // the last step
    std::size_t patterns_before          = 0;     // the resumed run
    std::size_t residuals_before         = 0;     // when the solver last began
    std::size_t pictured_step            = 0;     // the last one
    std::optional<std::size_t> stored_step;       // of the newest checkpoint
    std::vector<char>          told_of_lost_load; // per method
    std::chrono::steady_clock::time_point last_checkpoint;
    double                                earlier_seconds = 0;
    Vector                                u;
    Vector kept_u; // of a kept grid's nodes since the start
    std::vector<std::vector<Point<dim>>>          boundary_places; // per method
    std::vector<Measurements::BoundaryForce<dim>> forces;
    Measurements::Totals<dim>                     totals;
    RunRecord                                     run_record;
  };
} // namespace Impoint

#endif
