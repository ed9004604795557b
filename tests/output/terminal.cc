// What the terminal shows: silent, results, normal with few and many steps,
// talkative.
// Memory and time are plausible.

#include <impoint/output/machine.h>
#include <impoint/output/results_table.h>
#include <impoint/output/terminal.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <thread>

using namespace Impoint;

RunRecord example()
{
  RunRecord record;
  record.scene     = "beam.prm: a slender beam that bends under its own weight "
                     "until its tip hangs lower than its support";
  record.dimension = 2;
  record.ranks     = 1;
  record.basis     = "linear";
  record.solver    = "CHOLMOD";
  record.points    = 8192;
  record.boundaries            = {{"clamp", "projected penalty"}};
  record.results               = {{"tip u_y", -0.6774, -0.677458},
                                  {"α", 0.25, 0},
                                  {"angle without reference", 12345.678}};
  record.counters.steps        = 3;
  record.counters.halved_steps = 1;
  record.seconds.total         = 4000;
  record.seconds.solve         = 1000;
  record.peak_memory           = 123000000;
  return record;
}

std::string
steps(Terminal &terminal, std::ostringstream &out, const unsigned int n)
{
  out.str("");
  for (unsigned int step = 1; step <= n; ++step)
    {
      terminal.step({step, step * 1. / n, 1. / n, 1., 4, 0, 0.012});
      terminal.detail("Newton: residuals of step " + std::to_string(step));
      if (step == 2)
        terminal.message("Step 3 failed: halved.");
    }
  return out.str();
}

void show(const std::string &verbosity)
{
  std::cout << "=== " << verbosity << std::endl;
  std::ostringstream out, errors;
  Terminal           terminal(verbosity, MPI_COMM_WORLD, out, errors);
  terminal.header(example(), {{"cells", "20 x 40"}});
  std::istringstream header(out.str()); // the BLAS is the machine's own
  for (std::string line; std::getline(header, line);)
    if (verbosity == "normal" && line.find("BLAS") == std::string::npos &&
        line.find("impoint ") != 0)
      std::cout << line << '\n';
  errors.str("");
  terminal.warning("nothing but a test.");
  std::cout << steps(terminal, out, 2);
  out.str("");
  terminal.finish(example(), "results");
  terminal.failure("Error: nothing but a test.");
  std::cout << out.str() << "errors: " << errors.str();
}

void show_many_steps()
{
  std::ostringstream out;
  Terminal           terminal("normal", MPI_COMM_WORLD, out);
  const std::string  lines = steps(terminal, out, 400);
  std::cout << "=== 400 steps: " << std::count(lines.begin(), lines.end(), '\n')
            << " lines, the last:\n"
            << lines.substr(lines.rfind('\n', lines.size() - 2) + 1);
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  show("silent");
  show("results");
  show("normal");
  show_many_steps();
  show("talkative");
  for (const double seconds : {0.0123, 59.7, 60., 3599.9, 9000.})
    std::cout << duration(seconds) << std::endl;

  double seconds = 1;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const ScopedSeconds timer(seconds);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  const bool                adds_up  = seconds >= 1.02 && seconds < 2;
  const std::size_t         megabyte = 1000000;
  const std::size_t         before   = peak_memory(MPI_COMM_WORLD);
  const std::vector<double> large(30 * megabyte / sizeof(double), 1.);
  const std::size_t         grown = peak_memory(MPI_COMM_WORLD) - before;
  std::cout << "seconds add up: " << adds_up << "\n30 MB are seen: "
            << (grown > 20 * megabyte && grown < 40 * megabyte) << '\n'
            << "BLAS is known: " << !blas_in_use().name.empty() << std::endl;
}
