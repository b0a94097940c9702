// Random numbers from counters.
#include "kernels/math/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace barchan {
namespace {

/// Vigna's program of SplitMix64 gives these from the state 1234567 on, which grows by the same
/// odd number each time.
TEST(RandomNumbers, AreThoseOfTheReference) {
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15U;
  EXPECT_EQ(splitmix64(1234567), 6457827717110365317U);
  EXPECT_EQ(splitmix64(1234567 + step), 3203168211198807973U);
  EXPECT_EQ(splitmix64(1234567 + 2 * step), 9817491932198370423U);
}

/// Mean 1/2, variance 1/12; no correlation with the next count, another purpose or another seed.
/// Of n numbers each has the standard deviation that is written beside it.
TEST(RandomNumbers, AreUniformAndIndependent) {
  constexpr int n = 100000;
  double mean = 0, square = 0, next = 0, purpose = 0, seed = 0;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double u = uniform_number(1, 0, k) - 0.5;
    ASSERT_GE(u, -0.5);
    ASSERT_LT(u, 0.5);
    mean += u / n;
    square += u * u / n;
    next += u * (uniform_number(1, 0, k + 1) - 0.5) / n;
    purpose += u * (uniform_number(1, 1, k) - 0.5) / n;
    seed += u * (uniform_number(2, 0, k) - 0.5) / n;
  }
  const double root = std::sqrt(double{n});
  EXPECT_LT(std::abs(mean), 4 * std::sqrt(1.0 / 12) / root);
  EXPECT_LT(std::abs(square - 1.0 / 12), 4 * std::sqrt(1.0 / 180) / root);
  for (const double correlation : {next, purpose, seed})
    EXPECT_LT(std::abs(correlation), 4 * (1.0 / 12) / root);
}

}  // namespace
}  // namespace barchan
