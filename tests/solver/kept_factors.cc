// What the linear solver keeps: factors and hierarchies go on serving for
// similar matrices.

#include <deal.II/base/mpi.h>

#include "model_problem.h"

using namespace ModelProblem;

void reuse(const std::string &kind)
{
  Block<3> block(Settings{});
  Run<3>   run(kind, block.problem);
  std::cout << "Factorisations, " << kind;
  for (const double change : {0., 0., 1e-3, 2e-3, 100.})
    {
      block.set_penalty(1e4, change);
      if (change > 0)
        run.solver.new_matrix(block.problem);
      run.solve(block.load);
      std::cout << ' ' << run.counters.factorisations;
    }
  std::cout << std::endl;
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string kind : {"direct", "iterative"})
    reuse(kind);
}
