// Times at which a run writes.
#include "src/run/run_clock.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace barchan {
namespace {

std::vector<std::int64_t> due_steps(RunClock clock, double interval, std::int64_t until) {
  std::vector<std::int64_t> steps;
  for (clock.step = 0; clock.step <= until; ++clock.step)
    if (clock.due(interval)) steps.push_back(clock.step);
  return steps;
}

using Steps = std::vector<std::int64_t>;

TEST(RunClock, IsDueAtEachMultipleOfTheInterval) {
  EXPECT_EQ(due_steps({.fluid_step = 2.5e-4}, 1e-3, 12), (Steps{0, 4, 8, 12}));
  EXPECT_EQ(due_steps({.fluid_step = 1e-3}, 0.1, 300), (Steps{0, 100, 200, 300}));
  EXPECT_EQ(due_steps({.fluid_step = 3e-4}, 1e-4, 3), (Steps{0, 1, 2, 3})) << "not more often";
  EXPECT_EQ(due_steps({.fluid_step = 3e-4}, 0, 3), Steps{});
  EXPECT_EQ(due_steps({.fluid_step = 3e-4}, 1e300, 3), Steps{0});
}

/// Interval of 1 ms in steps of 0.3 ms, or 0.45 ms: the k-th time is that of the first step at or
/// after k intervals: 10 k / 3, or 3 k / 2, rounded up. It was 3 steps each time, 0.9 ms, or 2.
TEST(RunClock, KeepsToAnIntervalThatIsNoMultipleOfTheStep) {
  Steps thirds, halves;
  for (std::int64_t k = 0; 10 * k <= 3 * 100000; ++k) thirds.push_back((10 * k + 2) / 3);
  for (std::int64_t k = 0; 3 * k <= 2 * 100000; ++k) halves.push_back((3 * k + 1) / 2);
  EXPECT_EQ(due_steps({.fluid_step = 3e-4}, 1e-3, 100000), thirds);
  EXPECT_EQ(due_steps({.fluid_step = 3e-4}, 4.5e-4, 100000), halves);
  RunClock late{.fluid_step = 3e-4, .step = 10'000'000'000};  // 3e9 intervals from the start
  EXPECT_TRUE(late.due(1e-3));
  ++late.step;
  EXPECT_FALSE(late.due(1e-3));
}

}  // namespace
}  // namespace barchan
