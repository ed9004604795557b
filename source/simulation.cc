#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/boundary_forces.h>
#include <impoint/enforcement/proximity.h>
#include <impoint/history_row.h>
#include <impoint/output/machine.h>
#include <impoint/output/summary.h>
#include <impoint/setup.h>
#include <impoint/simulation.h>
#include <impoint/solver/motion.h>
#include <impoint/terms/body_force.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  template <int dim>
  Simulation<dim>::Simulation(ParameterFile    &file,
                              const Scene<dim> &scene,
                              const RunOptions &options,
                              const MPI_Comm    communicator)
    : start_of_run(std::chrono::steady_clock::now())
    , comm(communicator)
    , file(file)
    , scene(scene)
    , folder(options.output_folder.empty() ? file.absolute("Output/Folder") :
                                             options.output_folder,
             options.overwrite,
             comm,
             options.output_folder.empty() ? file.place("Output/Folder") :
                                             "option --output")
    , terminal(scene.output.verbosity, comm)
    , grid(file, scene.grid, comm)
    , basis(grid, file, scene.grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
    , conforming(basis)
    , methods(place_boundaries(file, scene, basis))
    , inertia(scene.time)
    , history(folder)
    , pictures(folder)
  {
    for (const auto &body : scene.bodies)
      body_forces.emplace_back(file, body.section + "/Body force", dim);
    for (unsigned int i = 0, m = 0; i < scene.boundaries.size(); ++i)
      if (scene.boundaries[i].kind == "conforming")
        conforming.add_boundary(file,
                                scene.conditions[i],
                                scene.boundaries[i].boundary_id);
      else if (!check_normals(file,
                              scene.boundaries[i],
                              methods[m++]->particles(),
                              *points,
                              grid))
        terminal.warning("No material is within 2 h of boundary '" +
                         scene.boundaries[i].name +
                         "': whether its normals point out of the material "
                         "cannot be checked.");
    system = std::make_unique<NonlinearSystem<dim>>(active,
                                                    *points,
                                                    methods,
                                                    conforming,
                                                    scene.linear_solver,
                                                    counters,
                                                    seconds);
    system->add_term(std::make_unique<InternalForce<dim>>(*points));
    newton = std::make_unique<Newton<dim>>(scene.newton, *system, counters);
    for (const auto &measurement : scene.measurements)
      measurements.push_back(Measurements::create<dim>(file, measurement));
    boundary_places.resize(methods.size());
    // Finds probes without material, before anything is written.
    const auto state = this->state();
    for (const auto &measurement : measurements)
      measurement->start(state);
    seconds.setup = seconds_since(start_of_run);
  }



  template <int dim>
  void Simulation<dim>::run()
  {
    begin();
    try
      {
        step_through();
      }
    catch (const RunFailed &failure)
      {
        end("failed", failure.what());
        throw;
      }
    end("done", "");
  }



  template <int dim>
  void Simulation<dim>::begin()
  {
    folder.create();
    std::ostringstream parameters;
    file.print_used(parameters);
    folder.write("parameters.prm", parameters.str());

    activate(0., scene.time.step);
    fill_record();
    terminal.header(run_record);
    picture();
  }



  template <int dim>
  Measurements::State<dim> Simulation<dim>::state() const
  {
    return {
      *points, methods, active, time, last_step, forces, newton->residuals()};
  }



  /** Steps of the given size to the end; halved where one fails, and doubled
   * again after two that did not. */
  template <int dim>
  void Simulation<dim>::step_through()
  {
    const double given   = scene.time.step;
    const double end     = scene.time.end;
    double       dt      = given;
    unsigned int success = 0;
    while (time < end - 1e-9 * given)
      {
        // Steps end on multiples of the given size, without a tiny last one.
        const double left = end - time;
        const double now  = left < dt * (1. + 1e-9) ? left : dt;
        try
          {
            advance(now);
            if (++success >= 2 && dt < given)
              {
                dt      = std::min(2. * dt, given);
                success = 0;
              }
          }
        catch (const StepFailed &failure)
          {
            std::ostringstream text;
            text << "step " << counters.steps + 1 << " at time " << time
                 << " s with a step of " << now << " s: " << failure.what();
            dt      = 0.5 * now;
            success = 0;
            ++counters.halved_steps;
            if (dt < scene.time.smallest * given)
              throw RunFailed(text.str() +
                              ". The step cannot be made smaller ('Smallest "
                              "step' in section 'Time')");
            terminal.detail(text.str() + "; halved");
          }
      }
  }



  /** Makes the cells with material active, and those of boundaries that act. */
  template <int dim>
  void Simulation<dim>::activate(const double start, const double end)
  {
    bool changed = false;
    {
      ScopedSeconds timer(seconds.pattern);
      changed =
        active.reinit(points->cells(), Enforcement::cells(methods, start, end));
    }
    if (changed)
      system->new_active_set();
    if (changed || points_changed_cells)
      system->find_starved_cells();
    points_changed_cells = false;
  }



  /** Prepares boundaries and balance of a step of length @p dt, with what is
   * prescribed at time @p end. */
  template <int dim>
  void Simulation<dim>::begin_step(const double dt, const double end)
  {
    Enforcement::Step<dim> step;
    step.start  = time;
    step.end    = end;
    step.young  = points->young();
    step.active = &active;
    step.points = points.get();
    for (const auto &method : methods)
      method->begin_step(step);
    const bool dynamic = scene.time.is_dynamic();
    if (dynamic)
      {
        ScopedSeconds timer(seconds.project);
        ++counters.projections;
        inertia.project(active, *points, dt);
      }
    system->begin_step(time,
                       end,
                       body_force(*points, active, body_forces, end),
                       dynamic ? &inertia : nullptr);
  }



  template <int dim>
  void Simulation<dim>::advance(const double dt)
  {
    activate(time, time + dt);
    if (scene.time.is_dynamic() && time == 0 &&
        scene.time.initial == "equilibrium")
      {
        // loads and walls as they are at the start
        begin_step(dt, time);
        Vector accelerations;
        system->initial_acceleration(accelerations);
        set_accelerations(active, accelerations, *points);
      }
    begin_step(dt, time + dt);

    u.reinit(active.unknowns());
    u.update_ghost_values();
    newton->solve(u);
    find_new_places();
    commit(dt);
  }



  /** Where everything will be; throws before anything has changed. */
  template <int dim>
  void Simulation<dim>::find_new_places()
  {
    ScopedSeconds timer(seconds.locate);
    const auto    places = new_places(*points, active, u);
    points->find(places);

    std::vector<double> cell_u;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        auto &particles = methods[m]->particles();
        boundary_places[m].resize(particles.n());
        for (unsigned int r = 0; r < particles.ranges().size(); ++r)
          {
            const unsigned int k = active.position(particles.ranges()[r].cell);
            const bool         is_active = k != BackgroundGrid<dim>::nowhere;
            if (is_active)
              system->gather(k, u, cell_u);
            methods[m]->new_places(r,
                                   is_active ? cell_u.data() : nullptr,
                                   boundary_places[m]);
          }
        if (methods[m]->moves())
          particles.find(boundary_places[m]);
      }
    if (scene.time.is_dynamic())
      Enforcement::check_crossing(
        methods, active, *points, places, boundary_places);
  }



  template <int dim>
  void Simulation<dim>::commit(const double dt)
  {
    last_step = dt;
    time += dt;
    ++counters.steps;
    {
      ScopedSeconds timer(seconds.update);
      sum_forces();
    }
    const auto before = state();
    for (const auto &measurement : measurements)
      measurement->follow(before, u);
    {
      ScopedSeconds timer(seconds.update);
      update_points(active,
                    u,
                    scene.time.is_dynamic() ? &inertia : nullptr,
                    *points);
    }
    {
      ScopedSeconds timer(seconds.locate);
      points_changed_cells = points->move();
      counters.sorts += points_changed_cells;
      for (unsigned int m = 0; m < methods.size(); ++m)
        if (methods[m]->moves())
          methods[m]->finish_step(boundary_places[m]);
    }
    const auto after = state();
    for (const auto &measurement : measurements)
      measurement->end_step(after);
    record();
  }



  /** What the boundaries did in the step: in the order of the scene, summed
   * over the ranks. */
  template <int dim>
  void Simulation<dim>::sum_forces()
  {
    const auto held = conforming_forces(*system, conforming, active, u);
    const auto nonconforming =
      nonconforming_forces(*system, methods, active, u);
    unsigned int next_held = 0, next_nonconforming = 0;
    forces.clear();
    for (const auto &boundary : scene.boundaries)
      {
        forces.push_back(boundary.kind == "conforming" ?
                           held[next_held++] :
                           nonconforming[next_nonconforming++]);
        forces.back().force  = Utilities::MPI::sum(forces.back().force, comm);
        forces.back().moment = Utilities::MPI::sum(forces.back().moment, comm);
      }
  }



  template <int dim>
  void Simulation<dim>::record()
  {
    ScopedSeconds timer(seconds.output);
    counters.visited_cells = Utilities::MPI::sum(active.n_cells(), comm);
    counters.visited_nodes = active.scalars()->size();

    history.write(history_row(state(), counters, measurements));

    terminal.step({static_cast<unsigned int>(counters.steps),
                   time,
                   last_step,
                   scene.time.end,
                   newton->iterations(),
                   static_cast<unsigned int>(counters.linear_iterations),
                   newton->residuals().back()});

    const bool last = time >= scene.time.end - 1e-9 * scene.time.step;
    if (scene.output.every > 0 &&
        (counters.steps % scene.output.every == 0 || last))
      picture();
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
      run_record.boundaries.emplace_back(
        scene.boundaries[i].name,
        scene.boundaries[i].kind == "conforming" ?
          "conforming" :
          (scene.conditions[i].constraint == "traction" ?
             "traction" :
             scene.conditions[i].enforcement));
    run_record.solver      = system->solver_description();
    run_record.counters    = counters;
    run_record.seconds     = seconds;
    run_record.peak_memory = peak_memory(comm);
  }



  template <int dim>
  void Simulation<dim>::end(const std::string &status,
                            const std::string &message)
  {
    seconds.total = seconds_since(start_of_run);
    fill_record();
    run_record.status  = status;
    run_record.message = message;
    run_record.results.clear();
    for (const auto &measurement : measurements)
      measurement->results(run_record.results);
    write_summary(run_record, folder);
    terminal.finish(run_record, folder.path());
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
