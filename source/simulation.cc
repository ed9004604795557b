#include <impoint/base/parameter_file.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/setup_checks.h>
#include <impoint/simulation.h>

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
    , resumed(options.resume)
    , used_parameters(as_used(file))
    , folder(checked_folder(file, options, comm))
    , report(file, scene, folder, counters, seconds)
    , stepper(file, scene, !resumed, comm, counters, seconds)
    , checkpoints(scene.output, counters)
    , constant_load(load_is_constant(file, scene))
  {
    step_size.size = scene.time.step;
    if (resumed)
      resume(read_newest_checkpoint(folder));
    else
      report.examine(stepper.state());
    report.choose_columns(stepper.state());
    seconds.setup += seconds_since(start_of_run);
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Impoint
