#ifndef impoint_output_run_record_h
#define impoint_output_run_record_h

#include <impoint/base/counters.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Impoint
{
  /** One line of the table of results. */
  struct Result
  {
    std::string name;
    double      value   = 0;
    double reference    = std::numeric_limits<double>::quiet_NaN(); // NaN: none
    std::string warning = ""; // why there is none
    double      error() const // relative where the reference is not zero
    {
      return reference == 0 ? std::abs(value) :
                              std::abs(value / reference - 1.);
    }
  };

  /** One row of history.csv: columns in the order in which they were added. */
  using HistoryRow = std::vector<std::pair<std::string, double>>;

  /** What summary.json says of a run. */
  struct RunRecord
  {
    std::string  status = "done"; // done|stopped|failed
    std::string  message;         // of a failed run
    std::string  scene;
    unsigned int dimension = 0, ranks = 0;
    std::string  basis, solver;
    std::vector<std::pair<std::string, std::string>> boundaries; // name, method
    std::vector<Result>                              results;
    std::vector<std::string>                         warnings;
    Counters                                         counters;
    Seconds                                          seconds;
    std::size_t points = 0, boundary_particles = 0, unknowns = 0;
    std::size_t peak_memory = 0; // bytes, largest rank
  };
} // namespace Impoint

#endif
