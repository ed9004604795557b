#include <impoint/base/stop_signals.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace Impoint
{
  namespace
  {
    volatile std::sig_atomic_t signal_arrived = 0;
    volatile std::sig_atomic_t is_suspended   = 0;

    const int ending[] = {SIGTERM, SIGINT, SIGHUP};

    void note_signal(const int number)
    {
      signal_arrived = 1;
      std::signal(number, SIG_DFL);
    }

    void suspend(int)
    {
      is_suspended = 1;
      raise(SIGSTOP);
    }

    void go_on(int, siginfo_t *signal, void *)
    {
      if (!is_suspended && signal->si_pid == getppid())
        signal_arrived = 1;
      is_suspended = 0;
    }

    bool is_started_by_open_mpi()
    {
      return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
    }
  } // namespace



  StopSignals::StopSignals()
  {
    signal_arrived = is_suspended = 0;
    for (const int number : ending)
      if (std::signal(number, note_signal) == SIG_IGN) // nohup
        std::signal(number, SIG_IGN);
    if (!is_started_by_open_mpi())
      return;
    std::signal(SIGTSTP, suspend);
    struct sigaction action = {};
    action.sa_sigaction     = go_on;
    action.sa_flags         = SA_SIGINFO | SA_RESTART;
    sigaction(SIGCONT, &action, nullptr);
  }



  StopSignals::~StopSignals()
  {
    for (const int number : ending)
      if (std::signal(number, SIG_DFL) == SIG_IGN)
        std::signal(number, SIG_IGN);
    if (is_started_by_open_mpi())
      for (const int number : {SIGTSTP, SIGCONT})
        std::signal(number, SIG_DFL);
  }



  bool StopSignals::arrived() const
  {
    return signal_arrived != 0;
  }
} // namespace Impoint
