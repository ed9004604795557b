#ifndef impoint_base_on_all_ranks_h
#define impoint_base_on_all_ranks_h

#include <mpi.h>

#include <functional>

namespace Impoint
{
  /**
   * Runs @p action, which must not communicate. If it throws InputError,
   * RunFailed or StepFailed on some rank, every rank throws the same exception:
   * of the gravest kind (in this order), with the message of the lowest rank
   * that threw it. An exception on one rank alone would leave the others
   * waiting in the next exchange. Collective.
   */
  void on_all_ranks(const MPI_Comm               communicator,
                    const std::function<void()> &action);

  /** The same, with @p action on rank 0 alone. Collective. */
  void on_root(const MPI_Comm               communicator,
               const std::function<void()> &action);

  /**
   * Whether all ranks come here within some seconds. If not, the others may be
   * waiting in an exchange for this rank: it must not start another one.
   * @p communicator must serve nothing else.
   */
  bool all_ranks_arrive(const MPI_Comm communicator);
} // namespace Impoint

#endif
