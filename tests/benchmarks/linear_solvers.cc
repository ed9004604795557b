// CPU times of the linear solvers on the model problem: CHOLMOD by its own
// defaults, our direct solver, the iteration. Not a test; run by hand:
//   OPENBLAS_NUM_THREADS=1 [mpirun -np 2] linear_solvers [dimension cells]
// Several ranks iterate together; times are those of the slowest, by the clock
// and, as these say little on a busy machine, in brackets what each of the
// ranks works without waiting for others.

#include <impoint/base/exceptions.h>
#include <impoint/solver/direct_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <suitesparse/cholmod.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "../solver/split_problem.h"

using namespace ModelProblem;

// Processor seconds in what waits for other ranks: MPI polls.
double waited = 0;

double processor_seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

template <typename Wait>
int count(const Wait &wait)
{
  const double start  = processor_seconds();
  const int    status = wait();
  waited += processor_seconds() - start;
  return status;
}

extern "C" int MPI_Waitall(int n, MPI_Request *requests, MPI_Status *statuses)
{
  return count([&]() { return PMPI_Waitall(n, requests, statuses); });
}

extern "C" int MPI_Allreduce(const void  *from,
                             void        *to,
                             int          n,
                             MPI_Datatype type,
                             MPI_Op       operation,
                             MPI_Comm     comm)
{
  return count(
    [&]() { return PMPI_Allreduce(from, to, n, type, operation, comm); });
}

extern "C" int MPI_Gatherv(const void  *from,
                           int          n,
                           MPI_Datatype type,
                           void        *to,
                           const int   *counts,
                           const int   *starts,
                           MPI_Datatype to_type,
                           int          root,
                           MPI_Comm     comm)
{
  return count([&]() {
    return PMPI_Gatherv(from, n, type, to, counts, starts, to_type, root, comm);
  });
}

extern "C" int MPI_Scatterv(const void  *from,
                            const int   *counts,
                            const int   *starts,
                            MPI_Datatype type,
                            void        *to,
                            int          n,
                            MPI_Datatype to_type,
                            int          root,
                            MPI_Comm     comm)
{
  return count([&]() {
    return PMPI_Scatterv(
      from, counts, starts, type, to, n, to_type, root, comm);
  });
}

// Seconds that CHOLMOD takes to analyse, factorise, solve.
template <int dim>
std::array<double, 3> bare_cholmod(const LinearProblem<dim> &problem,
                                   std::vector<double>       load)
{
  std::vector<int>    start(1, 0), rows;
  std::vector<double> values;
  for (unsigned int node = 0; node < problem.points.size(); ++node)
    for (unsigned int component = 0; component < dim; ++component)
      {
        for (std::size_t k = problem.pattern.row_start[node];
             k < problem.pattern.row_start[node + 1];
             ++k)
          for (unsigned int d = 0; d < dim; ++d)
            if (problem.pattern.columns[k] * dim + d >= node * dim + component)
              {
                rows.push_back(problem.pattern.columns[k] * dim + d);
                values.push_back(
                  problem.matrix.values[(k * dim + component) * dim + d]);
              }
        start.push_back(rows.size());
      }
  cholmod_sparse matrix = {};
  matrix.nrow = matrix.ncol = load.size();
  matrix.nzmax              = rows.size();
  matrix.p                  = start.data();
  matrix.i                  = rows.data();
  matrix.x                  = values.data();
  matrix.stype              = -1;
  matrix.xtype              = CHOLMOD_REAL;
  matrix.sorted = matrix.packed = true;
  cholmod_dense right           = {};
  right.nrow = right.d = right.nzmax = load.size();
  right.ncol                         = 1;
  right.x                            = load.data();
  right.xtype                        = CHOLMOD_REAL;

  cholmod_common common;
  cholmod_start(&common);
  Timer           timer;
  cholmod_factor *factor   = cholmod_analyze(&matrix, &common);
  const double    analysed = timer.cpu_time();
  cholmod_factorize(&matrix, factor, &common);
  const double   factorised = timer.cpu_time();
  cholmod_dense *solution   = cholmod_solve(CHOLMOD_A, factor, &right, &common);
  const double   solved     = timer.cpu_time();
  cholmod_free_dense(&solution, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return {{analysed, factorised - analysed, solved - factorised}};
}

/** Set-up of the pattern, first solve with all that it takes, one more. */
template <int dim>
void time_solver(const Block<dim> &block, const std::string &kind)
{
  LinearSolverParameters parameters;
  parameters.kind = kind;
  Counters            counters;
  LinearSolver<dim>   solver(parameters, counters);
  std::vector<double> x;
  Timer               timer;
  solver.new_pattern(block.problem);
  const double pattern = timer.cpu_time();
  try
    {
      solver.new_matrix(block.problem);
      solver.solve(block.problem, block.load, x);
      const double first      = timer.cpu_time();
      const auto   iterations = counters.linear_iterations;
      solver.solve(block.problem, block.load, x);
      const double again = timer.cpu_time() - first;
      std::printf(" %8.4f %8.4f %8.4f %3zu |",
                  pattern,
                  first - pattern - again,
                  again,
                  iterations);
    }
  catch (const std::runtime_error &error)
    {
      std::printf(" %s |", error.what());
    }
}

template <int dim>
void run(const unsigned int cells, const bool with_direct)
{
  Settings settings;
  settings.cells = cells;
  Block<dim> block(settings);
  for (const double factor : {1., 1e4, 1e8})
    {
      block.set_penalty(factor);
      std::printf(
        "%dD %4u %7zu %5.0e |", dim, cells, block.load.size(), factor);
      if (with_direct)
        {
          const std::array<double, 3> bare =
            bare_cholmod(block.problem, block.load);
          std::printf(" %8.4f %8.4f %8.4f |", bare[0], bare[1], bare[2]);
          time_solver(block, "direct");
        }
      else
        std::printf(" - | - |");
      time_solver(block, "iterative");
      std::printf("\n");
      std::fflush(stdout);
    }
}

template <int dim>
void run_together(const unsigned int cells)
{
  const auto slowest = [](const Timer &timer) {
    return Utilities::MPI::max(timer.wall_time(), MPI_COMM_WORLD);
  };
  Settings settings;
  settings.cells = cells;
  for (const double factor : {1., 1e4, 1e8})
    {
      Block<dim> block(settings);
      block.set_penalty(factor);
      SplitProblem<dim> split(block.problem);
      split.copy(block.problem);
      const std::vector<double> load = split.own(block.load);
      const std::size_t         n    = block.load.size();
      block.problem                  = LinearProblem<dim>();

      LinearSolverParameters parameters;
      parameters.kind = "iterative";
      Counters                counters;
      LinearSolver<dim>       solver(parameters, counters);
      DistributedProblem<dim> rows;
      std::vector<double>     x;
      MPI_Barrier(MPI_COMM_WORLD);
      Timer timer;
      rows.new_pattern(split.part, split.exchange());
      solver.new_pattern(rows.problem());
      const double pattern = slowest(timer);
      rows.new_matrix(split.part);
      solver.new_matrix(rows.problem());
      const double matrix = slowest(timer);
      solver.solve(rows.problem(), load, x);
      const double first      = slowest(timer);
      const auto   iterations = counters.linear_iterations;
      const double before     = processor_seconds() - waited;
      solver.solve(rows.problem(), load, x);
      const auto work =
        Utilities::MPI::gather(MPI_COMM_WORLD,
                               processor_seconds() - waited - before);
      const double again = slowest(timer) - first;
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          std::printf("%dD %4u %7zu %5.0e | %8.4f %8.4f %8.4f %8.4f %3zu [",
                      dim,
                      cells,
                      n,
                      factor,
                      pattern,
                      matrix - pattern,
                      first - matrix - again,
                      again,
                      iterations);
          for (const double seconds : work)
            std::printf(" %.4f", seconds);
          std::printf(" ]\n");
          std::fflush(stdout);
        }
    }
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::printf("dimension cells unknowns beta h/E | pattern, rows,"
                    " set-up, solve, iterations [work of ranks] [s]\n");
      const unsigned int cells = argc == 3 ? std::atoi(argv[2]) : 31;
      if (argc == 3 && std::atoi(argv[1]) == 2)
        run_together<2>(cells);
      else
        run_together<3>(cells);
      return 0;
    }
  std::printf(
    "dimension cells unknowns beta h/E | CHOLMOD: analyse factorise solve"
    " | direct: pattern, factor, solve, refinements"
    " | iterative: pattern, set-up, solve, iterations |  [s]\n");
  if (argc == 3)
    {
      const unsigned int cells = std::atoi(argv[2]);
      if (std::atoi(argv[1]) == 2)
        run<2>(cells, true);
      else
        run<3>(cells, cells <= 40);
      return 0;
    }
  for (const unsigned int cells : {100, 300})
    run<2>(cells, true);
  for (const unsigned int cells : {12, 24, 32})
    run<3>(cells, true);
}
