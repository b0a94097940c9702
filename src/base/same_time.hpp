// Comparison of times that were written and read back.
#pragma once

namespace barchan {

/// The largest time that may be `t` [s] after it was written with ten digits.
constexpr double last_same_time(double t) { return t * (1 + 1e-9); }

}  // namespace barchan
