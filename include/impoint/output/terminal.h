#ifndef impoint_output_terminal_h
#define impoint_output_terminal_h

#include <impoint/output/run_record.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  /** What the terminal says of a completed step. */
  struct StepReport
  {
    unsigned int step              = 0;
    double       time              = 0; // at the step's end
    double       dt                = 0;
    double       end_time          = 0; // of the run, which began at 0
    unsigned int newton_iterations = 0, linear_iterations = 0;
    double       residual = 0;
  };

  /**
   * What the user reads while the program runs. Rank 0 alone prints; no member
   * is collective.
   *
   * "silent" prints failures only; "results" warnings and the table of results;
   * "normal" a header, a line a step if they are few, else a progress bar (on a
   * terminal) or every 5 % a line (in a file), and the results; "talkative"
   * each step, details, and where the time went.
   */
  class Terminal
  {
  public:
    /** Failures and warnings go to @p errors, everything else to @p out. */
    Terminal(const std::string &verbosity,
             const MPI_Comm     communicator,
             std::ostream      &out    = std::cout,
             std::ostream      &errors = std::cerr);

    /**
     * Prints what is going to be computed, @p sizes as extra lines
     * (name, text) after the scene's. Time left is measured from here.
     */
    void
    header(const RunRecord                                        &record,
           const std::vector<std::pair<std::string, std::string>> &sizes = {});

    void step(const StepReport &report);

    /** Says something between two steps. */
    void message(const std::string &text);

    /** Says what only the talkative one says. */
    void detail(const std::string &text);

    void warning(const std::string &text);

    /** Prints @p text as it is, whatever the verbosity. */
    void failure(const std::string &text);

    /** Prints the results and what the run took; @p folder holds its files. */
    void finish(const RunRecord &record, const std::string &folder);

  private:
    enum class Style
    {
      undecided, // before the first step
      lines,
      bar,
      sparse_lines
    };

    void choose_style(const StepReport &first);
    void print_line(const StepReport &report);
    void print_bar(const StepReport &report);
    void clear_bar();
    void print_phases(const RunRecord &record);

    std::ostream &out, &errors;
    // false but on rank 0
    bool   results = false, normal = false, talkative = false;
    bool   on_root;
    bool   is_terminal;
    bool   bar_is_shown  = false;
    bool   columns_shown = false; // the head of the lines
    Style  style         = Style::undecided;
    double next_fraction = 0; // of sparse lines
    std::chrono::steady_clock::time_point start, last_bar;
  };
} // namespace Impoint

#endif
