#include "src/base/time_case.hpp"

#include <algorithm>
#include <cmath>

namespace barchan {
namespace {

constexpr double kRoundOff = 1e-9;  // round-off of a quotient

/// Smallest whole number >= x, up to the round-off of dividing decimal steps (100.00000000000001).
double ceil_tolerant(double x) { return std::ceil(x - kRoundOff * std::max(1.0, x)); }

}  // namespace

bool is_whole(double quotient) {
  return std::abs(quotient - std::round(quotient)) <= kRoundOff * std::max(1.0, quotient);
}

std::int64_t fluid_steps(const TimeConfig& time) {
  return static_cast<std::int64_t>(std::min(9e18, ceil_tolerant(time.end / time.fluid_step)));
}

int grain_substeps(const TimeConfig& time) {
  const double steps = ceil_tolerant(time.fluid_step / time.grain_step);
  return static_cast<int>(std::clamp(steps, 1.0, 2e9));
}

double true_grain_step(const TimeConfig& time) { return time.fluid_step / grain_substeps(time); }

}  // namespace barchan
