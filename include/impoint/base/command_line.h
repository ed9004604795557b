#ifndef impoint_base_command_line_h
#define impoint_base_command_line_h

#include <mpi.h>

#include <string>
#include <vector>

namespace Impoint
{
  /** What the command line says about a run beyond the scene. */
  struct RunOptions
  {
    std::string output_folder; // absolute; empty: as the scene says
    bool        overwrite = false;
    bool        resume    = false; // output_folder holds the checkpoint
  };

  /** The command line, see usage(). */
  struct CommandLine
  {
    enum class Action
    {
      run,
      check,
      print_parameters,
      help,
      version
    };

    /** Throws InputError for what usage() does not describe. */
    CommandLine(const int argc, const char *const *argv);

    static std::string usage();

    Action                   action = Action::run;
    std::string              scene; // may be empty for print_parameters
    std::vector<std::string> overrides;
    RunOptions               run_options;

  private:
    void choose(const Action chosen, const std::string &option);
    void take_option(const std::string &option, const std::string &value);
    void check() const;
    void take_resume(const std::string &folder);
    void check_resume() const;

    std::string action_option;  // the one that chose the action
    std::string resumed_folder; // absolute
  };

  /**
   * Tells the user what the exception being handled says and returns the exit
   * status: 1 for InputError, 2 otherwise. To be called in a catch block.
   * If all ranks of @p communicator come here within some seconds, rank 0 alone
   * speaks; if not, the others may be waiting for this rank: it speaks itself
   * and ends them all. @p communicator must serve nothing else.
   */
  int report_failure(const MPI_Comm communicator);

  /**
   * Keeps OpenBLAS, if that is the BLAS in use, from starting threads that
   * compete with the ranks. It reads its environment variable before main()
   * starts, too early for setenv(). A value set by the user stays.
   */
  void use_one_blas_thread();
} // namespace Impoint

#endif
