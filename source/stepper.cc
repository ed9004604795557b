#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/boundary_forces.h>
#include <impoint/enforcement/acting_cells.h>
#include <impoint/enforcement/held_areas.h>
#include <impoint/enforcement/proximity.h>
#include <impoint/setup.h>
#include <impoint/solver/motion.h>
#include <impoint/solver/stored_nodes.h>
#include <impoint/stepper.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  template <int dim>
  Stepper<dim>::Stepper(ParameterFile    &file,
                        const Scene<dim> &scene,
                        const bool        with_particles,
                        const MPI_Comm    communicator,
                        Counters         &counters,
                        Seconds          &seconds)
    : scene(scene)
    , comm(communicator)
    , counters(counters)
    , seconds(seconds)
    , grid(file, scene.grid, comm)
    , basis(grid, file, scene.grid)
    , active(basis)
    , hinges(grid)
    , points(with_particles ? place_bodies(file, scene, basis) :
                              without_points(file, scene, basis))
    , nearby_stiffness(active, *points)
    , conforming(basis)
    , methods(place_boundaries(file, scene, basis, *points, with_particles))
    , inertia(scene.time)
  {
    for (const auto &body : scene.bodies)
      body_loads.push_back(
        {Expression<dim>(file, body.section + "/Body force", dim),
         body.force_at_start});
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      if (!scene.has_particles(i))
        conforming.add_boundary(file, scene.conditions[i], scene.boundaries[i]);
    boundary_places.resize(methods.size());
    system = std::make_unique<NonlinearSystem<dim>>(active,
                                                    *points,
                                                    methods,
                                                    conforming,
                                                    scene.linear_solver,
                                                    counters,
                                                    seconds);
    system->add_term(
      std::make_unique<InternalForce<dim>>(*points, &end_states));
    system->set_ghost_penalty(scene.ghost_factor());
    newton = std::make_unique<Newton<dim>>(scene.newton, *system, counters);
    if (with_particles)
      totals = Measurements::totals(*points, comm);
  }



  template <int dim>
  std::string Stepper<dim>::of_step(const double dt) const
  {
    std::ostringstream text;
    text << "step " << counters.steps + 1 << " at time " << now
         << " s with a step of " << dt << " s: ";
    return text.str();
  }



  /** Makes the cells with material active, and those of boundaries that act. */
  template <int dim>
  void Stepper<dim>::activate(const double dt)
  {
    const double start = now, end = now + dt;
    bool         changed = false;
    {
      ScopedSeconds             timer(seconds.pattern);
      std::vector<unsigned int> reached;
      changed = active.reinit(
        points->cells(),
        Enforcement::cells(methods, start, end, scene.grid.is_kept()),
        [&]() {
          Enforcement::find_held_areas(methods, start, end, active, *points);
          return system->find_links(start, end);
        },
        [&](const auto &candidates) {
          const auto acting = Enforcement::acting_cells(
            methods, start, end, candidates, grid, *points, reached);
          // In dynamics masses hold what hangs on a node, and splines reach
          // farther.
          if (scene.time.moves_after(now) || !basis.lines().empty())
            return acting;
          const auto &between = hinges.cells_between(points->cells());
          std::vector<unsigned int> result;
          std::set_union(acting.begin(),
                         acting.end(),
                         between.begin(),
                         between.end(),
                         std::back_inserter(result));
          return result;
        });
      system->set_reached(reached);
    }
    if (changed || solver_starts_anew)
      system->new_active_set();
    if (changed || points_changed_cells || solver_starts_anew)
      system->find_starved_cells();
    points_changed_cells = solver_starts_anew = false;
  }



  /** Prepares boundaries and balance of a step of length @p dt, with what is
   * prescribed at time @p end. */
  template <int dim>
  void Stepper<dim>::begin_step(const double dt, const double end)
  {
    Enforcement::Step<dim> step;
    const bool             dynamic = scene.time.moves_after(now);
    step.start                     = now;
    step.end                       = end;
    nearby_stiffness.reinit();
    step.ghost_penalty = scene.ghost_factor();
    step.dynamic       = dynamic;
    step.active        = &active;
    step.points        = points.get();
    step.stiffness     = &nearby_stiffness;
    for (const auto &method : methods)
      method->begin_step(step);
    if (dynamic)
      {
        ScopedSeconds timer(seconds.project);
        counters.projections +=
          inertia.begin_step(active, *points, system->ghosts(), dt);
      }
    system->begin_step(now,
                       end,
                       body_force(*points,
                                  active,
                                  body_loads,
                                  end,
                                  dynamic ? inertia.sums_of_mass() : nullptr),
                       dynamic ? &inertia : nullptr,
                       scene.grid.is_kept() ? &kept_u : nullptr);
    // Newton's last residual is that of the solution, unless a step is linear.
    end_states.reinit(*points, !system->is_linear());
  }



  /** Balance before the first step, with loads and walls as they are at its
   * start. */
  template <int dim>
  void Stepper<dim>::start_motion(const double dt, StepObserver<dim> &observer)
  {
    const bool forces_wanted =
      counters.steps == 0 && observer.wants_first_forces();
    const bool accelerates =
      scene.time.moves_after(now) && !has_moved() &&
      scene.time.initial == InitialAcceleration::equilibrium;
    if (!forces_wanted && !accelerates)
      return;
    begin_step(dt, now);
    Vector w(active.unknowns());
    w.update_ghost_values();
    if (accelerates)
      {
        Vector accelerations;
        system->initial_acceleration(accelerations, w);
        set_accelerations(active, accelerations, *points);
        if (scene.grid.is_kept())
          inertia.carry(accelerations);
      }
    else
      system->balance_at_rest();
    if (!forces_wanted)
      return;
    sum_forces(conforming_forces(*system, conforming, active, w),
               balanced_forces(*system, methods, active, w));
    observer.begin(state());
  }



  template <int dim>
  void Stepper<dim>::advance(const double dt, StepObserver<dim> &observer)
  {
    activate(dt);
    if (scene.grid.is_kept())
      take_layout(active.unknowns(), kept_u);
    start_motion(dt, observer);
    begin_step(dt, now + dt);
    observer.prepared(state());
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
    commit(dt, observer);
  }



  /** Where everything will be; throws before anything has changed. */
  template <int dim>
  void Stepper<dim>::find_new_places()
  {
    ScopedSeconds timer(seconds.locate);
    auto         &places = end_states.places;
    if (!end_states.are_kept() && !scene.grid.is_kept())
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
    if (scene.time.moves_after(now) && !scene.grid.is_kept())
      Enforcement::check_crossing(
        methods, grid, *points, places, boundary_places);
  }



  template <int dim>
  void Stepper<dim>::commit(const double dt, StepObserver<dim> &observer)
  {
    const bool moves = scene.time.moves_after(now);
    whole            = false;
    last_step        = dt;
    now += dt;
    ++counters.steps;
    end_boundaries();
    observer.follow(state(), u);
    update_material(moves);
    move();
    observer.end_step(state(), u);
    whole = true;
  }



  template <int dim>
  void Stepper<dim>::end_boundaries()
  {
    ScopedSeconds timer(seconds.update);
    if (scene.grid.is_kept())
      {
        kept_u += u;
        kept_u.update_ghost_values();
      }
    end_step_of_boundaries(*system, methods, active, u);
    sum_forces(conforming_forces(*system,
                                 conforming,
                                 active,
                                 scene.grid.is_kept() ? kept_u : u),
               nonconforming_forces(*system, methods, active, u));
  }



  template <int dim>
  void Stepper<dim>::update_material(const bool moves)
  {
    ScopedSeconds                timer(seconds.update);
    Measurements::TotalsSum<dim> sum(*points);
    update_points<dim>(active,
                       u,
                       moves ? &inertia : nullptr,
                       end_states,
                       *points,
                       [&](const auto &range) {
                         sum.add(range);
                         points->renew_supports(range);
                       });
    totals = sum.of_all_ranks(comm);
    if (moves && scene.grid.is_kept())
      inertia.end_step(u);
  }



  template <int dim>
  void Stepper<dim>::move()
  {
    ScopedSeconds     timer(seconds.locate);
    const std::size_t evaluations_before = points->n_evaluations();
    points_changed_cells                 = points->move();
    counters.shape_values += points->n_evaluations() - evaluations_before;
    counters.sorts += points_changed_cells;
    for (unsigned int m = 0; m < methods.size(); ++m)
      if (methods[m]->moves())
        methods[m]->finish_step(boundary_places[m]);
  }



  template class Stepper<2>;
  template class Stepper<3>;
} // namespace Impoint
