#include <impoint/base/stop_signals.h>

#include <csignal>

namespace Impoint
{
  namespace
  {
    volatile std::sig_atomic_t signal_arrived = 0;

    void note_signal(const int number)
    {
      signal_arrived = 1;
      std::signal(number, SIG_DFL);
    }
  } // namespace



  StopSignals::StopSignals()
  {
    signal_arrived = 0;
    std::signal(SIGTERM, note_signal);
    std::signal(SIGINT, note_signal);
  }



  StopSignals::~StopSignals()
  {
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGINT, SIG_DFL);
  }



  bool StopSignals::arrived() const
  {
    return signal_arrived != 0;
  }
} // namespace Impoint
