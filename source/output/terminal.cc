#include <impoint/base/scoped_seconds.h>
#include <impoint/output/machine.h>
#include <impoint/output/results_table.h>
#include <impoint/output/terminal.h>

#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace Impoint
{
  namespace
  {
    /** More steps than these are not listed one by one. */
    constexpr double many_steps = 50;

    double fraction_done(const StepReport &report)
    {
      if (report.end_time <= 0)
        return 0;
      const double fraction = report.time / report.end_time;
      return fraction > 1 - 1e-9 ? 1. : fraction;
    }

    /** "  name      text", the text broken where its column ends. */
    std::string header_line(const std::string &name, const std::string &text)
    {
      const unsigned int indent = 22;
      const std::string  blank(indent, ' ');
      return padded("  " + name, indent - 1) + " " +
             wrapped(blank + text, indent).substr(indent);
    }

    template <typename... Numbers>
    std::string formatted(const char *format, const Numbers... numbers)
    {
      char text[160];
      std::snprintf(text, sizeof(text), format, numbers...);
      return text;
    }
  } // namespace



  Terminal::Terminal(const std::string &verbosity,
                     const MPI_Comm     communicator,
                     std::ostream      &out,
                     std::ostream      &errors)
    : out(out)
    , errors(errors)
    , on_root(Utilities::MPI::this_mpi_process(communicator) == 0)
    , is_terminal(&out == &std::cout && isatty(STDOUT_FILENO))
    , start(std::chrono::steady_clock::now())
  {
    Assert(verbosity == "silent" || verbosity == "results" ||
             verbosity == "normal" || verbosity == "talkative",
           ExcMessage("Unknown verbosity " + verbosity));
    results   = on_root && verbosity != "silent";
    normal    = results && verbosity != "results";
    talkative = on_root && verbosity == "talkative";
  }



  void Terminal::header(
    const RunRecord                                        &record,
    const std::vector<std::pair<std::string, std::string>> &sizes)
  {
    start = std::chrono::steady_clock::now();
    if (!normal)
      return;
    out << wrapped("impoint " IMPOINT_VERSION ": " + record.scene, 2)
        << header_line("dimension, ranks",
                       formatted("%u, %u", record.dimension, record.ranks))
        << header_line("points", std::to_string(record.points));
    if (record.boundary_particles > 0)
      out << header_line("boundary particles",
                         std::to_string(record.boundary_particles));
    if (record.unknowns > 0)
      out << header_line("unknowns", std::to_string(record.unknowns));
    for (const auto &[name, text] : sizes)
      out << header_line(name, text);

    const BlasInUse blas = blas_in_use();
    out << header_line("basis", record.basis)
        << header_line("solver", record.solver + ", " + blas.name);
    for (const auto &[name, method] : record.boundaries)
      out << header_line("boundary " + name, method);
    if (blas.reference)
      warning(
        "the program runs with the reference BLAS; direct solvers are 3 to 9 times faster with "
        "OpenBLAS (Debian package libopenblas0-pthread).");
    out << std::endl;
  }



  void Terminal::choose_style(const StepReport &first)
  {
    const double expected =
      first.dt > 0 ? first.step + (first.end_time - first.time) / first.dt : 0.;
    if (talkative || expected < many_steps + 0.5)
      style = Style::lines;
    else
      style = is_terminal ? Style::bar : Style::sparse_lines;
  }



  void Terminal::step(const StepReport &report)
  {
    if (!normal)
      return;
    if (style == Style::undecided)
      choose_style(report);

    if (style == Style::bar)
      print_bar(report);
    else if (style == Style::lines)
      print_line(report);
    else if (fraction_done(report) > next_fraction - 1e-9)
      {
        print_line(report);
        next_fraction =
          0.05 * (std::floor(fraction_done(report) / 0.05 + 1e-9) + 1);
      }
  }



  void Terminal::print_line(const StepReport &report)
  {
    if (!columns_shown)
      out
        << "    step           time             dt  Newton  linear   residual\n";
    columns_shown = true;
    out << formatted("%8u %14.7g %14.7g %7u %7u %10.2e\n",
                     report.step,
                     report.time,
                     report.dt,
                     report.newton_iterations,
                     report.linear_iterations,
                     report.residual)
        << std::flush;
  }



  void Terminal::print_bar(const StepReport &report)
  {
    const double       fraction = fraction_done(report);
    const double       refresh  = 0.1; // s
    const unsigned int length   = 30;
    if (bar_is_shown && fraction < 1 && seconds_since(last_bar) < refresh)
      return;
    last_bar = std::chrono::steady_clock::now();

    const unsigned int filled = fraction * length;
    std::string        left   = "";
    if (fraction > 0 && fraction < 1)
      left = ", " + duration(seconds_since(start) * (1 - fraction) / fraction) +
             " left";
    const std::string bar =
      std::string(filled, '#') + std::string(length - filled, '.');
    clear_bar();
    out << formatted("  [%s] %3.0f %%, step %u, time %.5g of %.5g%s",
                     bar.c_str(),
                     100 * fraction,
                     report.step,
                     report.time,
                     report.end_time,
                     left.c_str())
        << std::flush;
    bar_is_shown = true;
  }



  void Terminal::clear_bar()
  {
    if (bar_is_shown)
      out << "\r\033[K";
    bar_is_shown = false;
  }



  void Terminal::message(const std::string &text)
  {
    if (!normal)
      return;
    clear_bar();
    out << wrapped(text, 2) << std::flush;
  }



  void Terminal::detail(const std::string &text)
  {
    if (talkative)
      message(text);
  }



  void Terminal::warning(const std::string &text)
  {
    if (!results)
      return;
    clear_bar();
    out << std::flush;
    errors << wrapped("Warning: " + text, 2) << std::flush;
  }



  void Terminal::failure(const std::string &text)
  {
    if (!on_root)
      return;
    clear_bar();
    out << std::flush;
    errors << text << std::endl;
  }



  void Terminal::print_phases(const RunRecord &record)
  {
    const Seconds &seconds = record.seconds;
    for (const auto &[name, value] :
         {std::make_pair("setup", seconds.setup),
          std::make_pair("locate", seconds.locate),
          std::make_pair("pattern", seconds.pattern),
          std::make_pair("project", seconds.project),
          std::make_pair("assembly", seconds.assembly),
          std::make_pair("solve", seconds.solve),
          std::make_pair("update", seconds.update),
          std::make_pair("output", seconds.output)})
      out << formatted("  %-10s %10.3f s %6.1f %%\n",
                       name,
                       value,
                       seconds.total > 0 ? 100 * value / seconds.total : 0.);
  }



  void Terminal::finish(const RunRecord &record, const std::string &folder)
  {
    if (!results)
      return;
    // the full bar stays to be seen
    out << (bar_is_shown ? "\n\n" :
            normal       ? "\n" :
                           "")
        << results_table(record.results);
    bar_is_shown = false;
    if (!normal)
      return;
    if (!record.results.empty())
      out << '\n';
    if (talkative)
      print_phases(record);

    const Counters &counters = record.counters;
    std::string     steps    = formatted("%zu steps", counters.steps);
    if (counters.halved_steps > 0)
      steps += formatted(" (%zu halved)", counters.halved_steps);
    message(record.status + ": " + steps +
            formatted(", %zu Newton iterations", counters.newton_iterations) +
            ", " + duration(record.seconds.total) +
            formatted(", %.0f MB; files in ", record.peak_memory * 1e-6) +
            folder);
  }
} // namespace Impoint
