#ifndef impoint_output_machine_h
#define impoint_output_machine_h

#include <impoint/base/scoped_seconds.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace Impoint
{
  using namespace dealii;

  /** Largest resident memory of any rank so far [bytes]. Collective. */
  std::size_t peak_memory(const MPI_Comm communicator);

  /** The linear algebra kernels that the program was loaded with. */
  struct BlasInUse
  {
    std::string name;
    bool        reference =
      false; // the slow one: costs direct solvers a factor of 3 to 9
  };

  BlasInUse blas_in_use();
} // namespace Impoint

#endif
