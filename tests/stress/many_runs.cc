// Many runs in one process, which spares their start-up.
//
//   many_runs FOLDER
//
// reads lines "scene.prm<TAB>Section/Entry = value<TAB>..." and answers each
// with "0" and the processor seconds without the set-up, or the status that
// impoint would end with and its message, in one line. FOLDER holds the results
// of the last run.

#include <impoint/base/command_line.h>
#include <impoint/base/parameter_file.h>
#include <impoint/scene.h>
#include <impoint/simulation.h>

#include <algorithm>
#include <ctime>
#include <iostream>

using namespace Impoint;

template <int dim>
double run(ParameterFile &file, const RunOptions &options)
{
  const Scene<dim>   scene(file);
  Simulation<dim>    simulation(file, scene, options, MPI_COMM_WORLD);
  const std::clock_t start = std::clock();
  simulation.run();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

std::string answer(const int status, std::string message)
{
  std::replace(message.begin(), message.end(), '\n', ' ');
  return std::to_string(status) + " " + message;
}

std::string run_line(const std::string &line, const RunOptions &options)
{
  try
    {
      auto              words = Utilities::split_string_list(line, '\t');
      const std::string scene = words.front();
      words.erase(words.begin());
      ParameterFile file(scene, words);
      return answer(0,
                    std::to_string(file.raw("Dimension", "2") == "2" ?
                                     run<2>(file, options) :
                                     run<3>(file, options)));
    }
  catch (const InputError &error)
    {
      return answer(1, error.what());
    }
  catch (const std::exception &failure)
    {
      return answer(2, failure.what());
    }
}

int main(int argc, char *argv[])
{
  use_one_blas_thread();
  int                              no_options = 1;
  Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  RunOptions                       options;
  options.output_folder = argc > 1 ? argv[1] : "results";
  options.overwrite     = true;
  for (std::string line; std::getline(std::cin, line);)
    std::cout << run_line(line, options) << std::endl;
}
