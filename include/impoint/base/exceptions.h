#ifndef impoint_base_exceptions_h
#define impoint_base_exceptions_h

#include <stdexcept>
#include <string>

namespace Impoint
{
  /**
   * A mistake in the input: what is wrong (with the value), where it stands
   * (section, entry, file and line), and what to set instead. Ends the program
   * with status 1 before anything is computed or written.
   */
  class InputError : public std::runtime_error
  {
  public:
    InputError(const std::string &wrong,
               const std::string &place,
               const std::string &advice)
      : std::runtime_error("Error: " + wrong + "\n  in " + place + "\n  " +
                           advice)
    {}

    /** The message of another one, as a whole. */
    explicit InputError(const std::string &message)
      : std::runtime_error(message)
    {}
  };

  /**
   * A step that cannot be completed (Newton stalls, det F <= 0, a point moves
   * by more than a cell out of the grid). Simulation halves the step, of which
   * nothing is stored yet. On the way up it is caught to end on all ranks
   * alike (on_all_ranks(), Assembly), and where less can be tried first: a
   * shorter correction (Newton), another solver or matrix.
   */
  class StepFailed : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * The computation cannot go on; the last good state is on disk. Ends the
   * program with status 2.
   */
  class RunFailed : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Impoint

#endif
