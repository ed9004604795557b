#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <exception>
#include <string>
#include <thread>

namespace Impoint
{
  using namespace dealii;

  namespace
  {
    enum Failure
    {
      none,
      step_failed,
      run_failed,
      input_error
    };

    [[noreturn]] void throw_failure(const int          failure,
                                    const std::string &message)
    {
      if (failure == input_error)
        throw InputError(message);
      if (failure == run_failed)
        throw RunFailed(message);
      throw StepFailed(message);
    }
  } // namespace



  void on_all_ranks(const MPI_Comm               communicator,
                    const std::function<void()> &action)
  {
    int         failure = none;
    std::string message;
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        failure = input_error;
        message = error.what();
      }
    catch (const RunFailed &error)
      {
        failure = run_failed;
        message = error.what();
      }
    catch (const StepFailed &error)
      {
        failure = step_failed;
        message = error.what();
      }
    catch (const std::exception &error)
      {
        // of a library, or no memory: the others must not wait for this rank
        failure = run_failed;
        message = error.what();
      }

    const int gravest = Utilities::MPI::max(failure, communicator);
    if (gravest == none)
      return;
    if (failure != gravest)
      message.clear();
    for (const auto &of_rank :
         Utilities::MPI::all_gather(communicator, message))
      if (!of_rank.empty())
        throw_failure(gravest, of_rank);
    throw_failure(gravest, "a failure without a message");
  }



  void on_root(const MPI_Comm communicator, const std::function<void()> &action)
  {
    on_all_ranks(communicator, [&]() {
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        action();
    });
  }



  bool all_ranks_arrive(const MPI_Comm communicator)
  {
    MPI_Request request;
    MPI_Ibarrier(communicator, &request);
    const auto give_up =
      std::chrono::steady_clock::now() + std::chrono::seconds(5);
    int arrived = 0;
    while (true)
      {
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        if (arrived || std::chrono::steady_clock::now() > give_up)
          return arrived;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
  }
} // namespace Impoint
