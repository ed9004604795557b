#ifndef impoint_base_condition_numbers_h
#define impoint_base_condition_numbers_h

#include <limits>

namespace Impoint
{
  /** Of a symmetric matrix; NaN where there is none. */
  struct ConditionNumbers
  {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    double whole  = none; // largest eigenvalue over the smallest
    double scaled = none; // the same with a diagonal scaled to one
  };
} // namespace Impoint

#endif
