// What Simulation stores to go on from, and goes on from.

#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/simulation.h>

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
    archive &step_size.size &step_size.n_good;
    stepper.save_or_load(archive);
    for (std::size_t *count : counters.all())
      archive &*count;
    for (double *phase : seconds.all())
      archive &*phase;
    report.save_or_load(archive);
  }



  /** Writes a checkpoint if one is due; sets @p stop if any rank was told to
   * stop, which writes one later. Collective. */
  template <int dim>
  void Simulation<dim>::checkpoint(bool &stop)
  {
    const int told =
      Utilities::MPI::max(stop ? 2 : int(checkpoints.clock_asks()), comm);
    stop = told == 2;
    checkpoints.end_step(told == 1);
    if (checkpoints.solver_starts_anew())
      stepper.start_solver_anew();
    if (checkpoints.is_due())
      write_checkpoint();
  }



  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    ScopedSeconds timer(seconds.output);
    seconds.total = earlier_seconds + seconds_since(start_of_run);
    StateArchive of_run, particles;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      save_or_load(of_run);
    stepper.store(particles);
    Impoint::write_checkpoint(folder,
                              counters.steps,
                              of_run.bytes(),
                              particles.bytes());
    checkpoints.stored();
  }



  template <int dim>
  void Simulation<dim>::resume(StoredState stored)
  {
    StateArchive of_run(std::move(stored.run));
    on_all_ranks(comm, [&]() { save_or_load(of_run); });
    for (const auto &file_name : stored.damaged)
      report.warn("The checkpoint '" + file_name +
                  "' is damaged: going on from an older one.");
    patterns_before = counters.patterns;
    stepper.restore(stored.particles, step_size.size);
    checkpoints.stored();
    earlier_seconds = seconds.total;
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
