#ifndef impoint_base_stop_signals_h
#define impoint_base_stop_signals_h

namespace Impoint
{
  /**
   * While it lives, the first SIGTERM or SIGINT (Ctrl-C) does not end the
   * program but is noted, for the run to end in order after its step. The
   * second one ends it.
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
