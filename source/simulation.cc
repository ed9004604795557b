#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/setup.h>
#include <impoint/setup_checks.h>
#include <impoint/simulation.h>
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
        totals = Measurements::totals(*points, comm);
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
    if (!resumed)
      for (const auto &doubt : doubts_about_points(scene.grid, *points, basis))
        warn(doubt);
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



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
