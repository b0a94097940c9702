// Bytes read as decisions.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "tests/fuzz/fuzzed.hpp"

namespace barchan::fuzz {

/// The same bytes give the same decisions; zeros when they are used up.
class Tape {
 public:
  explicit Tape(Bytes bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const auto first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }

  /// Of n choices.
  std::size_t pick(std::size_t n) { return byte() % n; }
  template <class T, std::size_t N>
  T one_of(const std::array<T, N>& values) {
    return values[pick(N)];
  }

  /// Numbers that readers trip over.
  double number() {
    using Limits = std::numeric_limits<double>;
    return one_of(std::array{0.0, 1.0, -1.0, 0.5, 1e-300, 1e300, -1e300, 9.3e18, Limits::max(),
                             Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             Limits::denorm_min(), -0.0, 3e9, 2e-4});
  }
  std::int64_t integer() {
    using Limits = std::numeric_limits<std::int64_t>;
    return one_of(std::array<std::int64_t, 12>{0, 1, 2, 3, -1, 255, 1 << 20, std::int64_t{1} << 31,
                                               std::int64_t{1} << 32, Limits::max(), Limits::min(),
                                               5});
  }
  std::uint64_t extent() {
    return one_of(std::array<std::uint64_t, 16>{0, 1, 2, 3, 4, 12, 6, 100, 1000, 30000, 1 << 20,
                                                std::uint64_t{1} << 31, std::uint64_t{1} << 32,
                                                std::uint64_t{1} << 40, std::uint64_t{1} << 61,
                                                (std::uint64_t{1} << 62) + 1});
  }

 private:
  Bytes rest_;
};

}  // namespace barchan::fuzz
