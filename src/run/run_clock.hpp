// Time of a run in fluid steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/case/derived.hpp"

namespace barchan {

/// Time in fluid steps.
struct RunClock {
  double fluid_step = 0;                      // [s]
  std::int64_t step = 0, start = 0, end = 0;  // now; where this run began and ends

  double time() const { return static_cast<double>(step) * fluid_step; }  // [s]
  std::int64_t steps_done() const { return step - start; }
  /// Tells if output is due: at the start of a case and at the first step at or after each multiple
  /// of `interval` [s], or at every step if that is shorter; never if it is 0.
  bool due(double interval) const {
    if (!(interval > 0)) return false;
    if (step == 0) return true;
    const double steps = std::max(1.0, std::min(interval / fluid_step, 1e18));
    if (is_whole(steps)) return step % std::llround(steps) == 0;
    const auto passed = [steps](std::int64_t n) {  // a millionth of a step is rounding
      return std::floor((static_cast<double>(n) + 1e-6) / steps);
    };
    return passed(step) > passed(step - 1);
  }
};

}  // namespace barchan
