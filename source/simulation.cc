#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/measurements/totals.h>
#include <impoint/output/machine.h>
#include <impoint/output/summary.h>
#include <impoint/setup.h>
#include <impoint/simulation.h>
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
    , basis(grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
    , conforming(basis)
    , methods(place_boundaries(file, scene, basis))
    , inertia(scene.time)
    , history(folder)
    , pictures(folder)
  {
    folder.check();
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
    seconds.setup = std::chrono::duration<double>(
                      std::chrono::steady_clock::now() - start_of_run)
                      .count();
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
    std::vector<unsigned int> boundary_cells;
    for (const auto &method : methods)
      if (method->parameters().is_active(start, end))
        for (const auto &range : method->particles().ranges())
          boundary_cells.push_back(range.cell);
    std::sort(boundary_cells.begin(), boundary_cells.end());
    boundary_cells.erase(std::unique(boundary_cells.begin(),
                                     boundary_cells.end()),
                         boundary_cells.end());
    bool changed = false;
    {
      ScopedSeconds timer(seconds.pattern);
      changed = active.reinit(points->cells(), boundary_cells);
    }
    if (changed)
      system->new_active_set();
    if (changed || points_changed_cells)
      system->find_starved_cells();
    points_changed_cells = false;
  }



  template <int dim>
  void Simulation<dim>::advance(const double dt)
  {
    const bool dynamic = scene.time.is_dynamic();
    activate(time, time + dt);
    Enforcement::Step<dim> step;
    step.start  = time;
    step.end    = time + dt;
    step.young  = points->young();
    step.active = &active;
    for (const auto &method : methods)
      method->begin_step(step);

    const auto begin_step = [&]() {
      if (dynamic)
        {
          ScopedSeconds timer(seconds.project);
          ++counters.projections;
          inertia.project(active, *points, dt);
        }
      system->begin_step(time,
                         time + dt,
                         external_forces(time + dt),
                         dynamic ? &inertia : nullptr);
    };
    begin_step();
    if (dynamic && time == 0 && scene.time.initial == "equilibrium")
      {
        start_accelerations();
        begin_step();
      }

    u.reinit(active.unknowns());
    u.update_ghost_values();
    newton->solve(u);
    find_new_places();
    commit(dt);
  }



  /** The points' accelerations with which the run begins: M a = f. */
  template <int dim>
  void Simulation<dim>::start_accelerations()
  {
    Vector accelerations;
    system->initial_acceleration(accelerations);
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points->ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          for (unsigned int d = 0; d < dim; ++d)
            {
              double sum = 0;
              for (unsigned int a = 0; a < nodes.size(); ++a)
                sum += points->support(p)[a] *
                       accelerations.local_element(nodes[a] * dim + d);
              points->data(p)[points->slots().a + d] = sum;
            }
      }
  }



  template <int dim>
  typename Simulation<dim>::Vector
  Simulation<dim>::external_forces(const double at) const
  {
    Vector             forces(active.unknowns());
    const unsigned int mass = points->slots().mass;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points->ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            const Expression<dim> &force = body_forces[points->body(p)];
            if (force.is_zero())
              continue;
            const Tensor<1, dim> load =
              points->data(p)[mass] * force.vector(points->position(p), at);
            for (unsigned int a = 0; a < nodes.size(); ++a)
              for (unsigned int d = 0; d < dim; ++d)
                forces.local_element(nodes[a] * dim + d) +=
                  points->support(p)[a] * load[d];
          }
      }
    forces.compress(VectorOperation::add);
    return forces;
  }



  /** Where everything will be; throws before anything has changed. */
  template <int dim>
  void Simulation<dim>::find_new_places()
  {
    ScopedSeconds           timer(seconds.locate);
    std::vector<Point<dim>> places(points->n());
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points->ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            const double *N = points->support(p);
            places[p]       = points->position(p);
            for (unsigned int a = 0; a < nodes.size(); ++a)
              for (unsigned int d = 0; d < dim; ++d)
                places[p][d] += N[a] * u.local_element(nodes[a] * dim + d);
          }
      }
    points->find(places);

    std::vector<double> cell_u;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        auto &particles = methods[m]->particles();
        boundary_places[m].resize(particles.n());
        if (!methods[m]->moves())
          continue;
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
        particles.find(boundary_places[m]);
      }
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
      update_points();
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



  /** P Eqs. 22-25, and the points' new state. */
  template <int dim>
  void Simulation<dim>::update_points()
  {
    const auto                 &slots   = points->slots();
    const bool                  dynamic = scene.time.is_dynamic();
    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    std::vector<double>         new_history(points->carried().n_history);
    std::vector<double>         cell_u, cell_a;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto         nodes = active.nodes(k);
        const unsigned int n     = nodes.size();
        const auto        &range = points->ranges()[k];
        system->gather(k, u, cell_u);
        if (dynamic)
          {
            cell_a.resize(n * dim);
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                cell_a[a * dim + d] =
                  inertia.acceleration(nodes[a] * dim + d, cell_u[a * dim + d]);
          }
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            double        *state = points->data(p);
            const double  *N     = points->support(p);
            const double  *G     = N + n;
            Tensor<2, dim> grad_u;
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                {
                  state[slots.x + i] += N[a] * cell_u[a * dim + i];
                  state[slots.u + i] += N[a] * cell_u[a * dim + i];
                  for (unsigned int j = 0; j < dim; ++j)
                    grad_u[i][j] += cell_u[a * dim + i] * G[a * dim + j];
                }
            points->respond(
              p, grad_u, false, deformation, response, new_history.data());
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                state[slots.F + i * dim + j] = deformation.F[i][j];
            std::copy(response.stress.begin(),
                      response.stress.end(),
                      state + slots.stress);
            if (dim == 2)
              state[slots.stress + Voigt<dim>::n] = response.stress_zz;
            if (!new_history.empty())
              std::copy(new_history.begin(),
                        new_history.end(),
                        state + slots.history);
            for (unsigned int d = 0; d < dim && dynamic; ++d)
              {
                double a_new = 0;
                for (unsigned int a = 0; a < n; ++a)
                  a_new += N[a] * cell_a[a * dim + d];
                state[slots.v + d] = inertia.new_velocity(state[slots.v + d],
                                                          state[slots.a + d],
                                                          a_new);
                state[slots.a + d] = a_new;
              }
          }
      }
  }



  /** Forces and moments that the boundaries exert, with the particles of the
   * nonconforming ones brought up to date (but for their places). */
  template <int dim>
  void Simulation<dim>::sum_forces()
  {
    const auto moment_of = [](const Point<dim> &x, const Tensor<1, dim> &f) {
      Tensor<1, 3> moment;
      moment[2] = x[0] * f[1] - x[1] * f[0];
      if (dim == 3)
        {
          moment[0] = x[1] * f[dim - 1] - x[dim - 1] * f[1];
          moment[1] = x[dim - 1] * f[0] - x[0] * f[dim - 1];
        }
      return moment;
    };
    std::vector<Measurements::BoundaryForce<dim>> held(
      conforming.n_boundaries());
    for (unsigned int i = 0; i < held.size(); ++i)
      held[i].name = conforming.name(i);
    for (const auto &node : system->held_nodes())
      if (node.node < active.n_owned_nodes())
        {
          Point<dim> x = basis.point(active.grid_node(node.node));
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += u.local_element(node.node * dim + d);
          for (unsigned int k = 0; k < node.n_held; ++k)
            {
              const Tensor<1, dim> force = system->reaction(node, k);
              held[node.boundary[k]].force += force;
              held[node.boundary[k]].moment += moment_of(x, force);
            }
        }

    std::vector<Measurements::BoundaryForce<dim>> nonconforming(methods.size());
    std::vector<double>                           cell_u;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        auto &particles       = methods[m]->particles();
        nonconforming[m].name = particles.name();
        for (unsigned int r = 0; r < particles.ranges().size(); ++r)
          {
            const auto        &range = particles.ranges()[r];
            const unsigned int k     = active.position(range.cell);
            if (k == BackgroundGrid<dim>::nowhere || !methods[m]->is_active())
              {
                methods[m]->end_step(r, nullptr);
                continue;
              }
            system->gather(k, u, cell_u);
            methods[m]->end_step(r, cell_u.data());
            for (unsigned int b = range.begin; b < range.end; ++b)
              {
                Point<dim> x = particles.position(b);
                for (unsigned int i = 0; i < cell_u.size(); ++i)
                  x[i % dim] += particles.support(b)[i / dim] * cell_u[i];
                const Tensor<1, dim> force =
                  particles.vector(b, particles.slots().force);
                nonconforming[m].force += force;
                nonconforming[m].moment += moment_of(x, force);
              }
          }
      }

    // in the order of the scene, summed over the ranks
    forces.clear();
    unsigned int next_held = 0, next_nonconforming = 0;
    for (const auto &boundary : scene.boundaries)
      {
        forces.push_back(boundary.kind == "conforming" ?
                           held[next_held++] :
                           nonconforming[next_nonconforming++]);
        auto &sum  = forces.back();
        sum.force  = Utilities::MPI::sum(sum.force, comm);
        sum.moment = Utilities::MPI::sum(sum.moment, comm);
      }
  }



  template <int dim>
  void Simulation<dim>::record()
  {
    ScopedSeconds timer(seconds.output);
    counters.visited_cells = Utilities::MPI::sum(active.n_cells(), comm);
    counters.visited_nodes = active.scalars()->size();

    const auto totals = Measurements::totals(*points, comm);
    HistoryRow row;
    row.emplace_back("step", counters.steps);
    row.emplace_back("time", time);
    row.emplace_back("dt", last_step);
    row.emplace_back("Newton iterations", newton->iterations());
    row.emplace_back("linear iterations", counters.linear_iterations);
    row.emplace_back("residual", newton->residuals().back());
    row.emplace_back("active cells", counters.visited_cells);
    row.emplace_back("points", points->n_global());
    row.emplace_back("kinetic energy", totals.kinetic_energy);
    row.emplace_back("strain energy", totals.strain_energy);
    row.emplace_back("mass", totals.mass);
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(std::string("centre ") + "xyz"[d], totals.centre[d]);
    for (const auto &force : forces)
      {
        for (unsigned int d = 0; d < dim; ++d)
          row.emplace_back(force.name + " F_" + "xyz"[d], force.force[d]);
        for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
          row.emplace_back(force.name + " M_" + "xyz"[d], force.moment[d]);
      }
    for (const auto &measurement : measurements)
      measurement->columns(row);
    history.write(row);

    StepReport report;
    report.step              = counters.steps;
    report.time              = time;
    report.dt                = last_step;
    report.end_time          = scene.time.end;
    report.newton_iterations = newton->iterations();
    report.linear_iterations = counters.linear_iterations;
    report.residual          = newton->residuals().back();
    terminal.step(report);

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
    seconds.total = std::chrono::duration<double>(
                      std::chrono::steady_clock::now() - start_of_run)
                      .count();
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
