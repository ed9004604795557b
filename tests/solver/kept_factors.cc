// What the linear solver keeps and what that may cost: factors and hierarchies
// go on serving for similar matrices, and the regularisation of starved nodes,
// which is in the factors only, leaves no error.

#include <deal.II/base/mpi.h>

#include "model_problem.h"

using namespace ModelProblem;

/** Only the regularisation makes the factor exist, or a much too large one. */
template <int dim>
void starved(const std::string &kind, const double stiffness)
{
  Settings settings;
  settings.ridge = 0;
  Block<dim> block(settings);
  block.starve(stiffness);
  std::vector<double> exact(block.load.size()), b(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    exact[i] = std::sin(0.1 * i);
  block.problem.matrix.vmult(exact.data(), b.data());
  Run<dim> run(kind, block.problem);
  check("starved nodes leave no error, " + kind,
        distance(block.problem.matrix, run.solve(b), exact) < 1e-8);
}

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
    {
      for (const double stiffness : {1e-8, 1e-3})
        {
          starved<2>(kind, stiffness);
          starved<3>(kind, stiffness);
        }
      reuse(kind);
    }
}
