#include <impoint/base/command_line.h>
#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/base/paths.h>
#include <impoint/base/stop_signals.h>
#include <impoint/base/words.h>

#include <deal.II/base/exceptions.h>

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace Impoint
{
  namespace
  {
    const std::vector<std::string> long_options = {"--set",
                                                   "--output",
                                                   "--overwrite",
                                                   "--check",
                                                   "--print-parameters",
                                                   "--resume",
                                                   "--help",
                                                   "--version"};



    InputError command_line_error(const std::string &wrong,
                                  const std::string &advice)
    {
      return InputError(wrong, "the command line", advice);
    }



    bool takes_value(const std::string &option)
    {
      return option == "--set" || option == "--output" || option == "--resume";
    }



    // deal.II's exceptions come with a frame of many lines around what they
    // say.
    std::string internal_error(const std::exception &exception)
    {
      std::stringstream text;
      const auto       *framed =
        dynamic_cast<const dealii::ExceptionBase *>(&exception);
      if (framed != nullptr)
        {
          text << framed->get_exc_name() << ": ";
          framed->print_info(text);
        }
      else
        text << exception.what();
      std::string line = "Error: internal error:";
      for (std::string word; text >> word;)
        line += " " + word;
      return line;
    }



    std::pair<int, std::string> status_and_message()
    {
      try
        {
          throw;
        }
      catch (const InputError &error)
        {
          return {1, error.what()};
        }
      catch (const RunStopped &stop)
        {
          return {2, stop.what()};
        }
      catch (const RunFailed &error)
        {
          return {2, std::string("Error: ") + error.what()};
        }
      catch (const std::bad_alloc &)
        {
          return {2,
                  "Error: this computer has not enough memory for the scene"};
        }
      catch (const std::exception &error)
        {
          return {2, internal_error(error)};
        }
      catch (...) // Trilinos throws integers
        {
          return {2,
                  "Error: internal error: a library failed without a message"};
        }
    }
  } // namespace



  CommandLine::CommandLine(const int argc, const char *const *argv)
  {
    for (int i = 1; i < argc; ++i)
      {
        std::string argument = argv[i];
        if (argument.rfind("-", 0) != 0)
          {
            if (!scene.empty())
              throw command_line_error(
                "'" + argument + "' is a second scene after '" + scene + "'",
                "Run one scene at a time; quote what follows "
                "--set: --set \"Section/Entry = value\".");
            scene = argument;
            continue;
          }
        // --option=value is --option value
        const auto  equal  = argument.find('=');
        std::string option = argument.substr(0, equal), value;
        if (takes_value(option) && equal != std::string::npos)
          value = argument.substr(equal + 1);
        else if (takes_value(option) && i + 1 < argc)
          value = argv[++i];
        else
          option = argument;
        take_option(option, value);
      }
    check();
    if (run_options.resume)
      {
        scene =
          (std::filesystem::path(resumed_folder) / "parameters.prm").string();
        run_options.output_folder = resumed_folder;
      }
  }



  void CommandLine::take_option(const std::string &option,
                                const std::string &value)
  {
    if (takes_value(option) && (value.empty() || value.rfind("--", 0) == 0))
      throw command_line_error("nothing follows '" + option + "'",
                               option == "--set" ?
                                 "Write --set \"Section/Entry = value\"." :
                                 "Write " + option + " FOLDER.");
    if (option == "--set")
      overrides.push_back(value);
    else if (option == "--output")
      run_options.output_folder = absolute_path(value, "the command line");
    else if (option == "--overwrite")
      run_options.overwrite = true;
    else if (option == "--check")
      choose(Action::check, option);
    else if (option == "--print-parameters")
      choose(Action::print_parameters, option);
    else if (option == "--help" || option == "-h")
      choose(Action::help, option);
    else if (option == "--version")
      choose(Action::version, option);
    else if (option == "--resume")
      take_resume(value);
    else
      throw command_line_error("there is no option '" + option + "'",
                               Words::suggestion(option,
                                                 long_options,
                                                 "The options are"));
  }



  /** The folder says all: which scene, and where its results go. */
  void CommandLine::take_resume(const std::string &folder)
  {
    choose(Action::run, "--resume");
    run_options.resume = true;
    resumed_folder     = absolute_path(folder, "the command line");
  }



  void CommandLine::check_resume() const
  {
    std::string other;
    if (!scene.empty())
      other = "the scene '" + scene + "'";
    else if (!overrides.empty())
      other = "'--set'";
    else if (run_options.overwrite)
      other = "'--overwrite'";
    else if (!run_options.output_folder.empty())
      other = "'--output'";
    if (!other.empty())
      throw command_line_error("'--resume' and " + other +
                                 " exclude each other",
                               "Write 'impoint --resume FOLDER': it goes on "
                               "with the parameters of the run in FOLDER.");
    const auto parameters =
      std::filesystem::path(resumed_folder) / "parameters.prm";
    std::error_code ignored;
    if (!std::filesystem::exists(parameters, ignored))
      throw command_line_error("'" + resumed_folder +
                                 "' is not the output folder of a run: it has "
                                 "no parameters.prm",
                               "Give the folder of a run that was stopped.");
  }



  void CommandLine::choose(const Action chosen, const std::string &option)
  {
    if (!action_option.empty() && chosen != action)
      throw command_line_error("'" + action_option + "' and '" + option +
                                 "' exclude each other",
                               "Give one of them.");
    action        = chosen;
    action_option = option;
  }



  void CommandLine::check() const
  {
    if (run_options.resume)
      return check_resume();
    if (scene.empty() && (action == Action::run || action == Action::check))
      throw command_line_error(
        "no scene is given",
        "Write 'impoint SCENE.prm'; 'impoint --help' shows "
        "what else there is.");
  }



  std::string CommandLine::usage()
  {
    return R"(impoint: the implicit material point method with nonconforming boundaries

  impoint SCENE.prm                      run a scene; mpirun -np N impoint ... in parallel
  impoint --check SCENE.prm              check a scene only, run nothing
  impoint --resume FOLDER                go on from the newest checkpoint in the output
                                         folder of a run that was stopped
  impoint --print-parameters [SCENE.prm] every entry with its value, default, range and
                                         meaning; > new.prm makes a scene to start from
  impoint --help | --version

  --set "Section/Entry = value"          override an entry of the scene (repeatable)
  --output FOLDER                        where the results go
  --overwrite                            allow a folder that already holds results

Exit status: 0 done; 1 the input is wrong, nothing was computed or written;
2 the computation could not go on.
)";
  }



  int report_failure(const MPI_Comm communicator)
  {
    const auto [status, message] = status_and_message();
    int rank                     = 0;
    MPI_Comm_rank(communicator, &rank);
    const bool all_failed = all_ranks_arrive(communicator);
    if (rank == 0 || !all_failed)
      std::cerr << message << std::endl;
    if (!all_failed)
      MPI_Abort(communicator, status);
    return status;
  }



  void use_one_blas_thread()
  {
    if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr)
      return;
    using SetThreads = void (*)(int);
    if (const auto set_threads = reinterpret_cast<SetThreads>(
          dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set_threads(1);
  }
} // namespace Impoint
