#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/history_row.h>
#include <impoint/output/machine.h>
#include <impoint/setup_checks.h>
#include <impoint/simulation.h>

#include <iomanip>
#include <set>
#include <sstream>

namespace Impoint
{
  template <int dim>
  Measurements::State<dim> Simulation<dim>::state() const
  {
    return {*points,
            methods,
            active,
            time,
            last_step,
            forces,
            newton->residuals(),
            totals,
            [this]() { return system->condition_numbers(); }};
  }



  /** Those of history.csv; throws InputError if one occurs twice there or in
   * the results, of which the last would replace the others. */
  template <int dim>
  std::vector<std::string> Simulation<dim>::names_of_columns() const
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

    auto unused      = state();
    unused.residuals = {0.};
    unused.forces.clear();
    for (const auto &boundary : scene.boundaries)
      unused.forces.push_back({boundary.name, {}, {}});
    taken.clear();
    std::vector<std::string> names;
    for (const auto &column : history_row(unused, counters, 0, measurements))
      {
        take(column.first, "history.csv");
        names.push_back(column.first);
      }
    return names;
  }



  template <int dim>
  void Simulation<dim>::record()
  {
    ScopedSeconds timer(seconds.output);
    counters.visited_cells = Utilities::MPI::sum(active.n_cells(), comm);
    counters.visited_nodes = active.scalars()->size();

    const std::size_t linear_iterations =
      counters.linear_iterations - linear_iterations_before;
    linear_iterations_before = counters.linear_iterations;
    history.write(
      history_row(state(), counters, linear_iterations, measurements));

    terminal.step({static_cast<unsigned int>(counters.steps),
                   time,
                   last_step,
                   scene.time.end,
                   newton->iterations(),
                   static_cast<unsigned int>(linear_iterations),
                   newton->residuals().back()});

    const bool last = time >= scene.time.end - 1e-9 * scene.time.step;
    if (scene.output.every > 0 &&
        (counters.steps % scene.output.every == 0 || last))
      picture();
  }



  template <int dim>
  void Simulation<dim>::warn(const std::string &text)
  {
    run_record.warnings.push_back(text);
    terminal.warning(text);
  }



  template <int dim>
  void Simulation<dim>::picture()
  {
    if (scene.output.every == 0)
      return;
    std::vector<const BoundaryParticles<dim> *> boundaries;
    for (const auto &method : methods)
      boundaries.push_back(&method->particles());
    pictures.write(time, *points, boundaries, active, u);
    pictured_step = counters.steps;
  }



  template <int dim>
  void Simulation<dim>::fill_record()
  {
    run_record.scene     = scene.title.empty() ? file.file_name() : scene.title;
    run_record.dimension = dim;
    run_record.ranks     = Utilities::MPI::n_mpi_processes(comm);
    run_record.basis     = basis.name();
    run_record.points    = points->n_global();
    run_record.unknowns  = active.unknowns()->size();
    run_record.boundary_particles = 0;
    for (const auto &method : methods)
      run_record.boundary_particles += method->particles().n_global();
    run_record.boundaries.clear();
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      run_record.boundaries.emplace_back(scene.boundaries[i].name,
                                         !scene.has_particles(i) ?
                                           "conforming" :
                                           (scene.conditions[i].constraint ==
                                                "traction" ?
                                              "traction" :
                                              scene.conditions[i].enforcement));
    run_record.solver      = system->solver_description();
    run_record.counters    = counters;
    run_record.seconds     = seconds;
    run_record.peak_memory = peak_memory(comm);
  }



  template <int dim>
  void Simulation<dim>::warn_of_lost_loads()
  {
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        const auto &condition = methods[m]->parameters();
        if (condition.constraint != "traction" || told_of_lost_load[m] ||
            !methods[m]->is_active())
          continue;
        const double share = inactive_share(methods[m]->particles(), active);
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



  /** Those of all boundaries: in the order of the scene, summed over the
   * ranks. */
  template <int dim>
  void Simulation<dim>::sum_forces(
    const std::vector<Measurements::BoundaryForce<dim>> &held,
    const std::vector<Measurements::BoundaryForce<dim>> &nonconforming)
  {
    unsigned int next_held = 0, next_nonconforming = 0;
    forces.clear();
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      {
        forces.push_back(scene.has_particles(i) ?
                           nonconforming[next_nonconforming++] :
                           held[next_held++]);
        forces.back().force  = Utilities::MPI::sum(forces.back().force, comm);
        forces.back().moment = Utilities::MPI::sum(forces.back().moment, comm);
      }
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
