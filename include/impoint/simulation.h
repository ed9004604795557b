#ifndef impoint_simulation_h
#define impoint_simulation_h

#include <impoint/base/command_line.h>
#include <impoint/measurements/measurement.h>
#include <impoint/output/history.h>
#include <impoint/output/pictures.h>
#include <impoint/output/run_record.h>
#include <impoint/output/terminal.h>
#include <impoint/scene.h>
#include <impoint/solver/newton.h>

#include <deque>
#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * A run of a scene. The members are the modules in the order of the
   * computation; a step goes through them: activate, project, solve, move,
   * record.
   */
  template <int dim>
  class Simulation
  {
  public:
    /** Builds grid, particles and boundaries; computes and writes nothing.
     * Throws InputError for what only they reveal. */
    Simulation(ParameterFile    &file,
               const Scene<dim> &scene,
               const RunOptions &options,
               const MPI_Comm    communicator);

    /** Runs to the end. Throws RunFailed where it cannot go on; the last good
     * state is on disk then. */
    void run();

  private:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    void begin();
    void step_through();
    void advance(const double dt);
    void begin_step(const double dt, const double end);
    void activate(const double start, const double end);
    void find_new_places();
    void commit(const double dt);
    void sum_forces();
    void record();
    void picture();
    void fill_record();
    void end(const std::string &status, const std::string &message);

    Measurements::State<dim> state() const;

    const std::chrono::steady_clock::time_point                  start_of_run;
    MPI_Comm                                                     comm;
    ParameterFile                                               &file;
    const Scene<dim>                                            &scene;
    Counters                                                     counters;
    Seconds                                                      seconds;
    OutputFolder                                                 folder;
    Terminal                                                     terminal;
    BackgroundGrid<dim>                                          grid;
    Basis<dim>                                                   basis;
    ActiveNodes<dim>                                             active;
    std::vector<Expression<dim>>                                 body_forces;
    std::unique_ptr<MaterialPoints<dim>>                         points;
    Enforcement::Conforming<dim>                                 conforming;
    typename NonlinearSystem<dim>::Methods                       methods;
    Inertia<dim>                                                 inertia;
    std::unique_ptr<NonlinearSystem<dim>>                        system;
    std::unique_ptr<Newton<dim>>                                 newton;
    std::vector<std::unique_ptr<Measurements::Measurement<dim>>> measurements;
    HistoryWriter                                                history;
    Pictures<dim>                                                pictures;

    double                                        time = 0, last_step = 0;
    bool                                          points_changed_cells = true;
    Vector                                        u;
    std::vector<std::vector<Point<dim>>>          boundary_places; // per method
    std::vector<Measurements::BoundaryForce<dim>> forces;
    RunRecord                                     run_record;
  };
} // namespace Impoint

#endif
