#include <impoint/solver/quantile.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Impoint
{
  using namespace dealii;

  double quantile(const std::vector<double> &values,
                  const double               part,
                  const MPI_Comm             comm)
  {
    constexpr double accuracy = 1e-6;
    const auto       n_below  = [&](const double limit) {
      const std::size_t n =
        std::count_if(values.begin(), values.end(), [&](const double value) {
          return value >= 0 && value < limit;
        });
      return Utilities::MPI::sum(n, comm);
    };
    double low = 0, high = 0;
    for (const double value : values)
      high = std::max(high, value);
    high                 = 2 * Utilities::MPI::max(high, comm);
    const double n_lower = part * n_below(high);
    while (high - low > accuracy * high)
      {
        const double middle                      = (low + high) / 2;
        (n_below(middle) > n_lower ? high : low) = middle;
      }
    double found = 0;
    for (const double value : values)
      if (value < high)
        found = std::max(found, value);
    return Utilities::MPI::max(found, comm);
  }
} // namespace Impoint
