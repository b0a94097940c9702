// End and steps of a run.
#pragma once

#include <cstdint>

namespace barchan {

/// [time]
struct TimeConfig {
  double end = 0;  // [s], required
  double fluid_step =
      2.5e-4;  // [s]; in a case both steps are chosen by default (src/case/steps.hpp)
  double grain_step = 2.5e-6;   // [s]; fluid_step is cut into ceil(fluid_step / grain_step)
  double wall_clock_limit = 0;  // [s] of wall time, 0: none; then a restart and exit code 3
  bool operator==(const TimeConfig&) const = default;
};

/// Tells if a quotient of two times is a whole number up to round-off.
bool is_whole(double quotient);
/// Number of fluid steps of a run, ceil(end / fluid_step); a quotient within 1e-9 of a whole number
/// is that.
std::int64_t fluid_steps(const TimeConfig& time);
/// Number of grain steps per fluid step, ceil(fluid_step / grain_step) with the same round-off; at
/// least 1.
int grain_substeps(const TimeConfig& time);
/// Grain step really taken, fluid_step / grain_substeps [s].
double true_grain_step(const TimeConfig& time);

}  // namespace barchan
