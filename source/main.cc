#include <impoint/base/command_line.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/paths.h>
#include <impoint/scene.h>
#include <impoint/simulation.h>

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace Impoint;

template <int dim>
void execute(ParameterFile &file, const CommandLine &command, std::ostream &out)
{
  if (command.action == CommandLine::Action::print_parameters)
    {
      Scene<dim>::declare(file);
      file.apply();
      return file.print_template(out);
    }
  const Scene<dim> scene(file);
  Simulation<dim>  simulation(file, scene, command.run_options, MPI_COMM_WORLD);
  if (command.action == CommandLine::Action::check)
    out << command.scene << ": no mistakes found" << std::endl;
  else
    simulation.run();
}

void obey(const CommandLine &command, std::ostream &out)
{
  if (command.action == CommandLine::Action::help)
    return void(out << CommandLine::usage());
  if (command.action == CommandLine::Action::version)
    return void(out << "impoint " << IMPOINT_VERSION << std::endl);

  ParameterFile     file(command.scene, command.overrides);
  const std::string dim = file.raw("Dimension", "2");
  if (dim != "2" && dim != "3")
    throw file.error("Dimension", dim + " is not allowed", "Set 2 or 3.");
  dim == "2" ? execute<2>(file, command, out) : execute<3>(file, command, out);
}

int main(int argc, char *argv[])
{
  use_one_blas_thread();
  try
    {
      absolute_path(".", "the command line"); // else PETSc aborts
    }
  catch (const InputError &error)
    {
      std::cerr << error.what() << std::endl;
      return 1;
    }
  int                              no_options = 1; // PETSc would take --help
  Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  Utilities::MPI::DuplicatedCommunicator failures(MPI_COMM_WORLD);
  const bool   first = Utilities::MPI::this_mpi_process(*failures) == 0;
  std::ostream out(first ? std::cout.rdbuf() : nullptr);
  try
    {
      obey(CommandLine(argc, argv), out);
    }
  catch (...)
    {
      return report_failure(*failures);
    }
}
