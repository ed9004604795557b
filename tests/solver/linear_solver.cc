// The linear solver on elastic blocks with cut boundaries and slivers: the
// direct and the iterative kind agree whatever the enforcement's stiffness and
// the conforming conditions; singular and indefinite matrices are reported.

#include <impoint/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <iostream>

#include "model_problem.h"

using namespace ModelProblem;

/** The kinds agree to @p round_off in energy. */
template <int dim>
void compare(const std::string &name,
             const Block<dim>  &block,
             const double       round_off = 1e-8)
{
  Run<dim> direct("direct", block.problem),
    iterative("iterative", block.problem);
  direct.solve(block.load);
  iterative.solve(block.load);
  std::cout << name << ", " << iterative.solver.description() << std::endl;
  check("refinements <= 3", direct.counters.linear_iterations <= 3);
  check("iterations <= 20", iterative.counters.linear_iterations <= 20);
  check("same solution",
        distance(block.problem.matrix, iterative.x, direct.x) < round_off);
}

template <int dim>
void stiffnesses(const Settings &settings)
{
  Block<dim> block(settings);
  for (const char *factor : {"1", "1e4", "1e8"})
    {
      const double beta = std::stod(factor);
      block.set_penalty(beta);
      // Round-off of beta moves the modes that only the ridge of 1e-8 holds:
      // both kinds and the bare factor are 4e-8 ... 2e-7 away from a solution
      // in quadruple precision at 1e8, whatever the tolerance.
      compare(std::to_string(dim) + "D, beta h/E = " + factor,
              block,
              beta > 1e6 ? 1e-6 : 1e-8);
    }
}

/** Slivers that even the V-cycle leaves out. */
void thin_slivers()
{
  Block<3> block(Settings{8, false, true, true, 1e-8, 1e-8});
  block.set_penalty(1e4);
  compare("3D, thin slivers", block);
}

/** Nodes whose distances differ too much for a lattice to cover them. */
void graded()
{
  Block<3> block(Settings{8, false, true, false});
  block.set_penalty(1e4);
  for (Point<3> &point : block.problem.points)
    for (unsigned int d = 0; d < 3; ++d)
      point[d] = std::pow(point[d], 6);
  compare("3D, graded", block);
}

/** Nodes at the far end fixed, with diagonals far from all others. */
void conforming()
{
  Block<2> block(Settings{16});
  for (const double diagonal : {1e-9, 1e9})
    {
      block.fix_far_end(diagonal);
      compare("2D, conforming conditions", block);
    }
}

void failure(const std::string &name, const std::string &kind, Block<2> &block)
{
  try
    {
      Run<2>(kind, block.problem).solve(block.load);
      std::cout << name << ", " << kind << ": solved" << std::endl;
    }
  catch (const StepFailed &error)
    {
      const std::string message = error.what();
      std::cout << name << ", " << kind << ": "
                << message.substr(0, message.find_first_of(":(")) << std::endl;
    }
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  stiffnesses<2>(Settings{40});
  stiffnesses<3>(Settings{8});
  stiffnesses<3>(Settings{8, true, true, false});
  thin_slivers();
  graded();
  conforming();
  for (const std::string kind : {"direct", "iterative"})
    {
      Block<2> afloat(Settings{12, false, false, true, 0.});
      afloat.set_penalty(0);
      failure("No supports", kind, afloat);
      Block<2> indefinite(Settings{12});
      indefinite.problem.matrix.values[0] = -1;
      failure("Indefinite", kind, indefinite);
    }
}
