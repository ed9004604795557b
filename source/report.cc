#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/history_row.h>
#include <impoint/output/machine.h>
#include <impoint/output/summary.h>
#include <impoint/report.h>
#include <impoint/setup_checks.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

namespace Impoint
{
  template <int dim>
  Report<dim>::Report(ParameterFile      &file,
                      const Scene<dim>   &scene,
                      const OutputFolder &folder,
                      Counters           &counters,
                      Seconds            &seconds)
    : file(file)
    , scene(scene)
    , folder(folder)
    , comm(folder.communicator())
    , counters(counters)
    , seconds(seconds)
    , speaker(scene.output.verbosity, comm)
    , history(folder)
    , pictures(folder)
    , told_of_lost_load(scene.boundaries.size(), false)
  {
    for (const auto &measurement : scene.measurements)
      measurements.push_back(Measurements::create<dim>(file, measurement));
  }



  template <int dim>
  void Report<dim>::examine(const State &state)
  {
    for (const auto &doubt : scene.doubts())
      speaker.warning(doubt);
    for (const auto &doubt :
         doubts_about_points(scene.grid, state.points, state.active.basis()))
      warn(doubt);
    for (unsigned int i = 0, m = 0; i < scene.boundaries.size(); ++i)
      if (scene.has_particles(i))
        for (const auto &doubt :
             doubts_about_boundary(file,
                                   scene.boundaries[i],
                                   scene.conditions[i],
                                   state.methods[m++]->particles(),
                                   state.points,
                                   state.active.basis().grid()))
          warn(doubt);
    for (const auto &measurement : measurements)
      measurement->start(state);
  }



  /** None may occur twice there or in the results, of which the last would
   * replace the others. */
  template <int dim>
  void Report<dim>::choose_columns(const State &state)
  {
    std::set<std::string> taken;
    const auto take = [&](const std::string &name, const std::string &place) {
      if (!taken.insert(name).second)
        throw file.error("Measurements/Names",
                         "the name '" + name + "' occurs twice in " + place,
                         "Give what brings it about, a measurement or a "
                         "boundary, another name.");
    };
    std::vector<Result> results;
    for (const auto &measurement : measurements)
      measurement->results(results);
    for (const auto &result : results)
      take(result.name, "the results");

    auto unused      = state;
    unused.residuals = {0.};
    unused.forces.clear();
    for (const auto &boundary : scene.boundaries)
      unused.forces.push_back({boundary.name, {}, {}});
    taken.clear();
    columns.clear();
    for (const auto &column : history_row(unused, counters, 0, measurements))
      {
        take(column.first, "history.csv");
        columns.push_back(column.first);
      }
  }



  template <int dim>
  void Report<dim>::open()
  {
    history.begin(columns, counters.steps);
    linear_iterations_before = counters.linear_iterations;
  }



  template <int dim>
  void Report<dim>::header(const State &state, const std::string &solver)
  {
    describe(state, solver);
    speaker.header(run_record);
  }



  template <int dim>
  void Report<dim>::save_or_load(StateArchive &archive)
  {
    for (const auto &measurement : measurements)
      measurement->save_or_load(archive);
    pictures.save_or_load(archive);
    archive                                       &run_record
      .warnings &pictured_step &told_of_lost_load &told_of_round_off;
  }



  template <int dim>
  bool Report<dim>::wants_first_forces() const
  {
    return std::any_of(measurements.begin(),
                       measurements.end(),
                       [](const auto &measurement) {
                         return measurement->integrates_forces();
                       });
  }



  template <int dim>
  void Report<dim>::begin(const State &state)
  {
    for (const auto &measurement : measurements)
      measurement->begin(state);
  }



  template <int dim>
  void Report<dim>::follow(const State &state, const Vector &u)
  {
    for (const auto &measurement : measurements)
      {
        measurement->follow(state, u);
        const std::string text = measurement->take_warning();
        if (!text.empty())
          warn(text);
      }
  }



  template <int dim>
  void Report<dim>::end_step(const State &state, const Vector &u)
  {
    for (const auto &measurement : measurements)
      measurement->end_step(state);
    // what is round-off of nothing is no loss
    constexpr double nothing = 1e-14;
    if (state.residuals.back() * state.strain_of_forces > nothing)
      warn_of_round_off(state.residuals.back());
    record(state, u);
  }



  /** Steps whose residual is round-off end, however large it is. */
  template <int dim>
  void Report<dim>::warn_of_round_off(const double residual)
  {
    constexpr double small = 1e-3;
    if (told_of_round_off ||
        residual <= std::max(small, scene.newton.tolerance))
      return;
    told_of_round_off = true;
    std::ostringstream text;
    text << std::setprecision(2) << "step " << counters.steps
         << " leaves forces out of balance by " << residual
         << " of themselves: no digits are left where something much stiffer "
            "than the rest moves, a boundary or a body. Set a smaller 'Penalty "
            "factor', 'Enforcement = augmented Lagrangian' or 'nitsche', or "
            "bodies that differ less.";
    warn(text.str());
  }



  template <int dim>
  void Report<dim>::record(const State &state, const Vector &u)
  {
    ScopedSeconds timer(seconds.output);
    counters.visited_cells = Utilities::MPI::sum(state.active.n_cells(), comm);
    counters.visited_nodes = state.active.scalars()->size();

    const std::size_t linear_iterations =
      counters.linear_iterations - linear_iterations_before;
    linear_iterations_before = counters.linear_iterations;
    history.write(
      history_row(state, counters, linear_iterations, measurements));

    speaker.step({static_cast<unsigned int>(counters.steps),
                  state.time,
                  state.time_step,
                  scene.time.end,
                  static_cast<unsigned int>(state.residuals.size() - 1),
                  static_cast<unsigned int>(linear_iterations),
                  state.residuals.back()});

    const bool last = state.time >= scene.time.end - 1e-9 * scene.time.step;
    if (scene.output.every > 0 &&
        (counters.steps % scene.output.every == 0 || last))
      picture(state, u);
  }



  template <int dim>
  void Report<dim>::warn(const std::string &text)
  {
    run_record.warnings.push_back(text);
    speaker.warning(text);
  }



  template <int dim>
  void Report<dim>::picture(const State &state, const Vector &u)
  {
    if (scene.output.every == 0)
      return;
    std::vector<const BoundaryParticles<dim> *> boundaries;
    for (const auto &method : state.methods)
      boundaries.push_back(&method->particles());
    pictures.write(state.time, state.points, boundaries, state.active, u);
    pictured_step = counters.steps;
  }



  template <int dim>
  void Report<dim>::picture_if_missing(const State &state, const Vector &u)
  {
    if (pictured_step != counters.steps)
      picture(state, u);
  }



  template <int dim>
  void Report<dim>::describe(const State &state, const std::string &solver)
  {
    run_record.scene     = scene.title.empty() ? file.file_name() : scene.title;
    run_record.dimension = dim;
    run_record.ranks     = Utilities::MPI::n_mpi_processes(comm);
    run_record.basis     = state.active.basis().name();
    run_record.points    = state.points.n_global();
    run_record.unknowns  = state.active.unknowns()->size();
    run_record.boundary_particles = 0;
    for (const auto &method : state.methods)
      run_record.boundary_particles += method->particles().n_global();
    run_record.boundaries.clear();
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      run_record.boundaries.emplace_back(scene.boundaries[i].name,
                                         !scene.has_particles(i) ?
                                           "conforming" :
                                           (scene.conditions[i].constraint ==
                                                Constraint::traction ?
                                              "traction" :
                                              scene.conditions[i].enforcement));
    run_record.solver      = solver;
    run_record.counters    = counters;
    run_record.seconds     = seconds;
    run_record.peak_memory = peak_memory(comm);
  }



  template <int dim>
  void Report<dim>::prepared(const State &state)
  {
    for (unsigned int m = 0; m < state.methods.size(); ++m)
      {
        const auto &method    = *state.methods[m];
        const auto &condition = method.parameters();
        if (condition.constraint != Constraint::traction ||
            told_of_lost_load[m] || !method.is_active())
          continue;
        const double share = inactive_share(method.particles(), state.active);
        if (share == 0)
          continue;
        told_of_lost_load[m] = true;
        std::ostringstream text;
        text << std::setprecision(2) << 100 * share << " % of boundary '"
             << condition.name
             << "' have no material in their cells: the load there is lost "
                "(step "
             << counters.steps + 1 << ")";
        warn(text.str());
      }
  }



  template <int dim>
  void Report<dim>::finish(const State       &state,
                           const std::string &solver,
                           const std::string &status,
                           const std::string &message)
  {
    describe(state, solver);
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
    speaker.finish(run_record, folder.path());
  }



  template class Report<2>;
  template class Report<3>;
} // namespace Impoint
