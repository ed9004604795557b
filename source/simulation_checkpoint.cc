// What Simulation stores to go on from, and goes on from.

#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/particles/stored_particles.h>
#include <impoint/simulation.h>
#include <impoint/solver/stored_nodes.h>

#include <map>

namespace Impoint
{
  namespace
  {
    using Values = std::vector<std::pair<std::string, std::string>>;

    /** The entries without which a stored state means nothing: in which cells
     * particles are, whose they are, what their history is. */
    Values what_must_agree(const ParameterFile &file)
    {
      Values values;
      for (const auto &[path, value] : file.used())
        if (path == "Dimension" || path == "Time/Kind" ||
            path.rfind("Grid/", 0) == 0 || Words::last_part(path) == "Names" ||
            Words::last_part(path) == "Model")
          values.emplace_back(path, value);
      return values;
    }



    void check_agreement(const ParameterFile &file, const Values &stored)
    {
      const std::map<std::string, std::string> old(stored.begin(),
                                                   stored.end());
      for (const auto &[path, value] : what_must_agree(file))
        {
          const auto found = old.find(path);
          if (found == old.end() || found->second != value)
            throw file.error(path,
                             "'" + value + "' does not fit the checkpoint, " +
                               (found == old.end() ?
                                  "whose run had no such entry" :
                                  "whose run had '" + found->second + "'"),
                             "Resume with the entry as it was, or run the "
                             "altered scene from its beginning.");
        }
    }
  } // namespace



  /** All but the particles; the same on all ranks, but for what rank 0 alone
   * counts and writes. */
  template <int dim>
  void Simulation<dim>::save_or_load(StateArchive &archive)
  {
    archive.tag("impoint " + std::to_string(dim) + "D");
    auto     stored = what_must_agree(file);
    archive &stored;
    if (archive.reads())
      check_agreement(file, stored);
    archive &time &last_step &step_size.size &step_size.n_good;
    archive                                  &inertia.largest_energy();
    for (std::size_t *count : counters.all())
      archive &*count;
    for (double *phase : seconds.all())
      archive &*phase;
    for (const auto &measurement : measurements)
      measurement->save_or_load(archive);
    pictures.save_or_load(archive);
    archive &run_record.warnings &pictured_step &told_of_lost_load;
  }



  /** Whether the last step had inertia: not before the first one that has. */
  template <int dim>
  bool Simulation<dim>::has_moved() const
  {
    return counters.steps > 0 && scene.time.moves_after(time - last_step);
  }



  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    ScopedSeconds timer(seconds.output);
    seconds.total = earlier_seconds + seconds_since(start_of_run);
    StateArchive of_run, particles;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      save_or_load(of_run);
    store_particles(*points, grid, particles);
    for (const auto &method : methods)
      {
        particles.tag(method->particles().name());
        store_particles(method->particles(), grid, particles);
      }
    if (scene.grid.is_kept() && counters.steps > 0)
      store_nodes(active, kept_u, particles);
    if (scene.grid.is_kept() && has_moved())
      for (Vector *vector : inertia.carried())
        store_nodes(active, *vector, particles);
    Impoint::write_checkpoint(folder,
                              counters.steps,
                              of_run.bytes(),
                              particles.bytes());
    stored_step     = counters.steps;
    last_checkpoint = std::chrono::steady_clock::now();
  }



  template <int dim>
  void Simulation<dim>::resume(StoredState stored)
  {
    StateArchive of_run(std::move(stored.run));
    on_all_ranks(comm, [&]() { save_or_load(of_run); });
    for (const auto &file_name : stored.damaged)
      warn("The checkpoint '" + file_name +
           "' is damaged: going on from an older one.");
    earlier_seconds          = seconds.total;
    linear_iterations_before = counters.linear_iterations;
    patterns_before          = counters.patterns;
    residuals_before         = counters.residuals;
    stored_step              = counters.steps;

    const OwnCells cells = own_cells(grid);
    restore_particles(stored.particles, cells, comm, *points);
    for (const auto &method : methods)
      {
        stored.particles.for_each([&](StateArchive &archive) {
          archive.tag(method->particles().name());
        });
        restore_particles(stored.particles, cells, comm, method->particles());
      }
    if (scene.grid.is_kept() && counters.steps > 0)
      {
        activate(time, time + step_size.size);
        restore_nodes(stored.particles, cells, active, kept_u);
      }
    if (scene.grid.is_kept() && has_moved())
      {
        inertia.project(active, *points, system->ghosts(), step_size.size);
        for (Vector *vector : inertia.carried())
          restore_nodes(stored.particles, cells, active, *vector);
        inertia.set_carried();
      }
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
