#ifndef impoint_solver_quantile_h
#define impoint_solver_quantile_h

#include <mpi.h>

#include <vector>

namespace Impoint
{
  /** Of all ranks' @p values that are not negative, about the one above this
   * @p part of them (1/2: the median), to a millionth or, if many are equal,
   * their very value; 0 of nothing. Collective. */
  double quantile(const std::vector<double> &values,
                  const double               part,
                  const MPI_Comm             comm);
} // namespace Impoint

#endif
