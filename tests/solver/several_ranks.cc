// Rows sent to their owners, products, the band preconditioner and the check
// for rigid modes on several ranks: the solution of a direct solver on one, in
// at most 20 iterations; ranks without nodes.

#include <impoint/base/exceptions.h>
#include <impoint/solver/rigid_modes.h>

#include <deal.II/base/mpi.h>

#include <iostream>

#include "split_problem.h"

using namespace ModelProblem;

void say(const std::string &text)
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << text << std::endl;
}

void check_all(const std::string &what, const bool passed)
{
  const bool all = Utilities::MPI::min(int(passed), MPI_COMM_WORLD);
  say("  " + what + ": " + (all ? "yes" : "no"));
}

template <int dim>
struct Distributed
{
  explicit Distributed(const LinearProblem<dim> &whole,
                       const unsigned int        n_idle = 0)
    : split(whole, n_idle)
  {
    split.copy(whole);
    rows.new_pattern(split.part, split.exchange());
    rows.new_matrix(split.part);
  }

  SplitProblem<dim>       split;
  DistributedProblem<dim> rows;
};

template <int dim>
void compare(const std::string &name,
             const Block<dim>  &block,
             const unsigned int n_idle = 0,
             const double       bound  = 1e-8)
{
  Distributed<dim> distributed(block.problem, n_idle);
  Run<dim>         run("iterative", distributed.rows.problem());
  const auto       x =
    distributed.split.all(run.solve(distributed.split.own(block.load)));
  Run<dim> direct("direct", block.problem);
  direct.solve(block.load);
  say(name + ", " + run.solver.description());
  check_all("same solution",
            distance(block.problem.matrix, x, direct.x) < bound);
  check_all("iterations <= 20", run.counters.linear_iterations <= 20);
}

template <int dim>
std::string freedom(const LinearProblem<dim> &problem)
{
  try
    {
      check_rigid_modes(problem);
      return "held";
    }
  catch (const RunFailed &error)
    {
      return error.what();
    }
}

/** Two blocks; what is said of the second is the same as on one rank. */
void rigid_modes()
{
  Settings settings;
  settings.ridge = 0;
  Block<2> block(settings);
  check_all("held: as on one rank",
            freedom(Distributed<2>(block.problem).rows.problem()) ==
              freedom(block.problem));
  block.set_penalty(0);
  say("  " + freedom(Distributed<2>(block.problem).rows.problem()));
  check_all("free: as on one rank",
            freedom(Distributed<2>(block.problem).rows.problem()) ==
              freedom(block.problem));
}

void indefinite()
{
  Block<2> block(Settings{12});
  block.problem.matrix.values[0] = -1;
  Distributed<2> distributed(block.problem);
  try
    {
      Run<2>("iterative", distributed.rows.problem())
        .solve(distributed.split.own(block.load));
      say("Indefinite: solved");
    }
  catch (const StepFailed &error)
    {
      const std::string message = error.what();
      say("Indefinite: " + message.substr(0, message.find_first_of(":(")));
    }
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool lattice : {true, false})
    {
      Block<2> square(Settings{40, false, true, lattice});
      Block<3> cube(Settings{8, true, true, lattice});
      for (const double factor : {1., 1e8})
        {
          square.set_penalty(factor);
          cube.set_penalty(factor);
          const double bound = factor > 1e6 ? 1e-6 : 1e-8;
          compare("2D", square, 0, bound);
          compare("3D", cube, 0, bound);
        }
      compare("3D, a rank without nodes", cube, 1, 1e-6);
    }
  Block<2> fixed(Settings{16});
  fixed.fix_far_end(1e9);
  compare("2D, conforming conditions", fixed);
  rigid_modes();
  indefinite();
}
