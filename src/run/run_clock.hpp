// Where a run is in time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace barchan {

/// Time in fluid steps.
struct RunClock {
  double fluid_step = 0;                      // [s]
  std::int64_t step = 0, start = 0, end = 0;  // now; where this run began and ends

  double time() const { return static_cast<double>(step) * fluid_step; }  // [s]
  std::int64_t steps_done() const { return step - start; }
  /// True at the start of a case and every `interval` [s] (a whole number of steps, at least one);
  /// never if that is 0.
  bool due(double interval) const {
    if (!(interval > 0)) return false;
    const double steps = std::min(interval / fluid_step, 1e18);
    return step % std::max<std::int64_t>(1, std::llround(steps)) == 0;
  }
};

}  // namespace barchan
