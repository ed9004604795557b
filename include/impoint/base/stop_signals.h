#ifndef impoint_base_stop_signals_h
#define impoint_base_stop_signals_h

#include <impoint/base/exceptions.h>

namespace Impoint
{
  /** A run that could go on but was told not to. */
  class RunStopped : public RunFailed
  {
  public:
    using RunFailed::RunFailed;
  };

  /**
   * While it lives, the first SIGTERM, SIGINT (Ctrl-C) or SIGHUP (a terminal
   * that is closed) does not end the program but is noted, for the run to end
   * in order after its step. The second one of a kind ends it.
   *
   * Open MPI's mpirun does not pass Ctrl-C on: it sends SIGCONT at once,
   * SIGTERM and SIGKILL after a while each (odls_base_sigkill_timeout, 1 s).
   * SIGCONT from there is noted, too, unless SIGTSTP (Ctrl-Z) came before.
   */
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals &)            = delete;
    StopSignals &operator=(const StopSignals &) = delete;

    /** Whether this process was told to stop. */
    bool arrived() const;
  };
} // namespace Impoint

#endif
