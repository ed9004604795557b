#ifndef impoint_base_scoped_seconds_h
#define impoint_base_scoped_seconds_h

#include <chrono>

namespace Impoint
{
  /** Wall-clock seconds that have passed since @p start. */
  inline double seconds_since(const std::chrono::steady_clock::time_point start)
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start)
      .count();
  }

  /** Adds the wall-clock seconds of its life to @p accumulator. */
  class ScopedSeconds
  {
  public:
    explicit ScopedSeconds(double &accumulator)
      : accumulator(accumulator)
      , start(std::chrono::steady_clock::now())
    {}

    ~ScopedSeconds()
    {
      accumulator += seconds_since(start);
    }

    ScopedSeconds(const ScopedSeconds &)            = delete;
    ScopedSeconds &operator=(const ScopedSeconds &) = delete;

  private:
    double                                     &accumulator;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace Impoint

#endif
