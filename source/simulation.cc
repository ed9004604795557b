#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/enforcement/acting_cells.h>
#include <impoint/enforcement/proximity.h>
#include <impoint/setup.h>
#include <impoint/setup_checks.h>
#include <impoint/simulation.h>
#include <impoint/solver/motion.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  namespace
  {
    std::string as_used(const ParameterFile &file)
    {
      std::ostringstream text;
      file.print_used(text);
      return text.str();
    }



    OutputFolder checked_folder(const ParameterFile &file,
                                const RunOptions    &options,
                                const MPI_Comm       communicator)
    {
      const bool         given = !options.output_folder.empty();
      const OutputFolder folder(given ? options.output_folder :
                                        file.absolute("Output/Folder"),
                                options.overwrite || options.resume,
                                communicator,
                                options.resume ? "option --resume" :
                                given          ? "option --output" :
                                                 file.place("Output/Folder"));
      folder.check();
      return folder;
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(ParameterFile    &file,
                              const Scene<dim> &scene,
                              const RunOptions &options,
                              const MPI_Comm    communicator)
    : start_of_run(std::chrono::steady_clock::now())
    , comm(communicator)
    , failures(communicator)
    , file(file)
    , scene(scene)
    , used_parameters(as_used(file))
    , folder(checked_folder(file, options, comm))
    , terminal(scene.output.verbosity, comm)
    , grid(file, scene.grid, comm)
    , basis(grid, file, scene.grid)
    , active(basis)
    , points(options.resume ? without_points(file, scene, basis) :
                              place_bodies(file, scene, basis))
    , conforming(basis)
    , methods(place_boundaries(file, scene, basis, *points, !options.resume))
    , inertia(scene.time)
    , history(folder)
    , pictures(folder)
    , resumed(options.resume)
    , constant_load(load_is_constant(file, scene))
    , told_of_lost_load(methods.size(), false)
    , last_checkpoint(start_of_run)
  {
    for (const auto &body : scene.bodies)
      body_loads.push_back(
        {Expression<dim>(file, body.section + "/Body force", dim),
         body.force_place == "start"});
    step_size.size = scene.time.step;
    boundary_places.resize(methods.size());
    check_boundaries();
    system = std::make_unique<NonlinearSystem<dim>>(active,
                                                    *points,
                                                    methods,
                                                    conforming,
                                                    scene.linear_solver,
                                                    counters,
                                                    seconds);
    system->add_term(
      std::make_unique<InternalForce<dim>>(*points, &end_states));
    system->set_ghost_penalty(scene.grid.ghost_factor());
    newton = std::make_unique<Newton<dim>>(scene.newton, *system, counters);
    for (const auto &measurement : scene.measurements)
      measurements.push_back(Measurements::create<dim>(file, measurement));
    if (resumed)
      resume(read_newest_checkpoint(folder));
    else
      {
        // Finds probes without material, before anything is written.
        const auto state = this->state();
        for (const auto &measurement : measurements)
          measurement->start(state);
      }
    columns = names_of_columns();
    seconds.setup += seconds_since(start_of_run);
  }



  template <int dim>
  void Simulation<dim>::check_boundaries()
  {
    if (!resumed)
      for (const auto &doubt : scene.doubts())
        terminal.warning(doubt);
    for (unsigned int i = 0, m = 0; i < scene.boundaries.size(); ++i)
      if (!scene.has_particles(i))
        conforming.add_boundary(file, scene.conditions[i], scene.boundaries[i]);
      else if (!resumed)
        for (const auto &doubt :
             doubts_about_boundary(file,
                                   scene.boundaries[i],
                                   scene.conditions[i],
                                   methods[m++]->particles(),
                                   *points,
                                   grid))
          warn(doubt);
  }



  /** Makes the cells with material active, and those of boundaries that act. */
  template <int dim>
  void Simulation<dim>::activate(const double start, const double end)
  {
    bool changed = false;
    {
      ScopedSeconds             timer(seconds.pattern);
      std::vector<unsigned int> reached;
      changed = active.reinit(
        points->cells(),
        Enforcement::cells(methods, start, end, scene.grid.is_kept()),
        [&]() { return system->find_links(start, end); },
        [&](const auto &candidates) {
          return Enforcement::acting_cells(
            methods, start, end, candidates, grid, *points, reached);
        });
      system->set_reached(reached);
    }
    // Resumed or gone on after a checkpoint: the same digits with a new factor.
    if (changed || solver_starts_anew)
      system->new_active_set();
    if (changed || points_changed_cells || solver_starts_anew)
      system->find_starved_cells();
    points_changed_cells = solver_starts_anew = false;
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
    const bool dynamic = scene.time.moves_after(time);
    if (dynamic)
      {
        ScopedSeconds timer(seconds.project);
        counters.projections += inertia.begin_step(active, *points, dt);
      }
    system->begin_step(time,
                       end,
                       body_force(*points,
                                  active,
                                  body_loads,
                                  end,
                                  dynamic ? &inertia.nodal_masses() : nullptr),
                       dynamic ? &inertia : nullptr);
    // Newton's last residual is that of the solution, unless a step is linear.
    end_states.reinit(*points, !system->is_linear());
  }



  template <int dim>
  void Simulation<dim>::advance(const double dt)
  {
    activate(time, time + dt);
    if (scene.time.moves_after(time) && !has_moved() &&
        scene.time.initial == "equilibrium")
      {
        // loads and walls as they are at the start
        begin_step(dt, time);
        Vector accelerations;
        system->initial_acceleration(accelerations);
        set_accelerations(active, accelerations, *points);
        if (scene.grid.is_kept())
          inertia.carry(accelerations);
      }
    begin_step(dt, time + dt);
    warn_of_lost_loads();
    u.reinit(active.unknowns());
    u.update_ghost_values();
    newton->solve(u);
    try
      {
        find_new_places();
      }
    catch (const RunFailed &failure)
      {
        throw RunFailed(of_step(dt) + failure.what());
      }
    commit(dt);
  }



  /** Where everything will be; throws before anything has changed. */
  template <int dim>
  void Simulation<dim>::find_new_places()
  {
    ScopedSeconds timer(seconds.locate);
    if (!scene.grid.is_kept())
      new_places(*points, active, u, places);
    counters.searches += points->find(places, "material point");
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
          particles.find(boundary_places[m],
                         "in boundary '" + particles.name() + "' particle");
      }
    if (scene.time.moves_after(time) && !scene.grid.is_kept())
      Enforcement::check_crossing(
        methods, grid, *points, places, boundary_places);
  }



  template <int dim>
  void Simulation<dim>::commit(const double dt)
  {
    const bool moves = scene.time.moves_after(time);
    is_whole         = false;
    last_step        = dt;
    time += dt;
    ++counters.steps;
    {
      ScopedSeconds timer(seconds.update);
      sum_forces();
    }
    const auto before = state();
    for (const auto &measurement : measurements)
      {
        measurement->follow(before, u);
        const std::string text = measurement->take_warning();
        if (!text.empty())
          warn(text);
      }
    {
      ScopedSeconds timer(seconds.update);
      update_points(active, u, moves ? &inertia : nullptr, end_states, *points);
      if (moves && scene.grid.is_kept())
        inertia.end_step(u);
    }
    {
      ScopedSeconds timer(seconds.locate);
      counters.shape_values -= points->n_evaluations();
      points_changed_cells = points->move();
      counters.shape_values += points->n_evaluations();
      counters.sorts += points_changed_cells;
      for (unsigned int m = 0; m < methods.size(); ++m)
        if (methods[m]->moves())
          methods[m]->finish_step(boundary_places[m]);
    }
    const auto after = state();
    for (const auto &measurement : measurements)
      measurement->end_step(after);
    record();
    is_whole = true;
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
