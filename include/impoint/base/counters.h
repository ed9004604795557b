#ifndef impoint_base_counters_h
#define impoint_base_counters_h

#include <cstddef>
#include <vector>

namespace Impoint
{
  /**
   * What a run has done, as printed in summary.json: the proof that a scene
   * skips what it does not need.
   */
  struct Counters
  {
    std::size_t steps        = 0;
    std::size_t halved_steps = 0;
    std::size_t sorts        = 0; // steps in which some point changed its cell
    std::size_t searches     = 0; // for the cells of the points
    std::size_t shape_values = 0; // how often those of all points were renewed
    std::size_t patterns     = 0; // sparsity patterns built
    std::size_t tangents     = 0;
    std::size_t residuals    = 0;
    std::size_t factorisations    = 0; // or preconditioners set up
    std::size_t linear_iterations = 0;
    std::size_t newton_iterations = 0;
    std::size_t projections       = 0; // of mass and momentum
    std::size_t visited_cells     = 0; // in the last step
    std::size_t visited_nodes     = 0; // in the last step
    std::size_t starved_cells     = 0; // with too few points, in the last step

    std::vector<std::size_t *> all()
    {
      return {&steps,
              &halved_steps,
              &sorts,
              &searches,
              &shape_values,
              &patterns,
              &tangents,
              &residuals,
              &factorisations,
              &linear_iterations,
              &newton_iterations,
              &projections,
              &visited_cells,
              &visited_nodes,
              &starved_cells};
    }
  };

  /** Wall-clock seconds of a run's phases, as printed in summary.json. */
  struct Seconds
  {
    double total = 0, setup = 0, locate = 0, pattern = 0, project = 0,
           assembly = 0, solve = 0, update = 0, output = 0;

    std::vector<double *> all()
    {
      return {&total,
              &setup,
              &locate,
              &pattern,
              &project,
              &assembly,
              &solve,
              &update,
              &output};
    }
  };
} // namespace Impoint

#endif
