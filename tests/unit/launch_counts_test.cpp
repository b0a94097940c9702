// How often a step launches a kernel, and how often the host waits for one: on a device each costs
// microseconds, whatever the size of the case.
#include <gtest/gtest.h>

#include "src/coupling/state_checks.hpp"
#include "src/initial/initial_state.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/launch_counter.hpp"

namespace barchan {

namespace {

std::string listed(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, n] : counts) text += "\n  " + std::to_string(n) + "  " + name;
  return text;
}

// Of a fluid step with 100 grain steps in the life of a neighbour list. A host does not take grain
// steps ahead, and waits for each of them.
TEST(LaunchCounts, OfACoupledStepAreBounded) {
  Config config = test::coupled_config();
  config.time.grain_step = config.time.fluid_step / 100;
  SystemState state = make_initial_state(config, {});
  CoupledStep step(config, state);
  step.start(state);
  const StateChecks checks(config, MPI_COMM_SELF);
  std::map<std::string, int> launches, waits;
  for (int s = 0; s < 30 && launches.empty(); ++s) {
    const std::int64_t before = step.neighbor_list()->rebuilds();
    const test::LaunchCounter counter;
    step.advance(state);
    checks.check(state, step);
    if (s >= 3 && step.neighbor_list()->rebuilds() == before)
      launches = counter.launches(), waits = counter.waits();
  }
  ASSERT_FALSE(launches.empty()) << "a list outlives a fluid step";
  if (kOnHost) {
    std::erase_if(launches, [](const auto& l) { return l.first.starts_with("grains: in"); });
    waits.erase("copy to excess over the skin");
  }
  EXPECT_LE(test::LaunchCounter::sum(launches), 150) << listed(launches);
  EXPECT_LE(test::LaunchCounter::sum(waits), 10) << listed(waits);
  EXPECT_GT(test::LaunchCounter::sum(launches), 50) << "they are counted";
  EXPECT_GT(test::LaunchCounter::sum(waits), 5) << "they are counted";
}

}  // namespace

}  // namespace barchan
