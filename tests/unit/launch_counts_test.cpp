// Numbers of kernel launches and of waits of the host in a step: on a device each costs
// microseconds, whatever the size of the case.
#include <gtest/gtest.h>

#include <iostream>

#include "src/coupling/state_checks.hpp"
#include "src/initial/initial_state.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/launch_counter.hpp"
#include "tests/support/measured.hpp"

namespace barchan {

namespace {

std::string listed(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, n] : counts) text += "\n  " + std::to_string(n) + "  " + name;
  return text;
}

// Fluid step with 100 grain steps in the life of a neighbour list. A host does not take grain steps
// ahead, and waits for each of them.
TEST(LaunchCounts, OfACoupledStepAreBounded) {
  Config config = test::coupled_config();
  config.time.grain_step = config.time.fluid_step / 100;
  config.grains->skin = 2e-4;  // for lists that last
  SystemState state = make_initial_state(config, {});
  CoupledStep step(config, state);
  step.start(state);
  const StateChecks checks(config, MPI_COMM_SELF);
  std::map<std::string, int> launches, waits;
  std::int64_t rebuilds = 0;
  int steps_of_list = 0;
  for (int s = 0; s < 100 && launches.empty(); ++s) {
    const test::LaunchCounter counter;
    step.advance(state);
    checks.check(state, step);
    steps_of_list = step.neighbor_list()->rebuilds() == rebuilds ? steps_of_list + 1 : 0;
    rebuilds = step.neighbor_list()->rebuilds();
    if (steps_of_list == 3) launches = counter.launches(), waits = counter.waits();
  }
  ASSERT_FALSE(launches.empty()) << "a list outlives a fluid step";
  if (kOnHost) {
    std::erase_if(launches, [](const auto& l) { return l.first.starts_with("grains: in"); });
    waits.erase("copy to excess over the skin");
  }
  const int n_launches = test::LaunchCounter::sum(launches),
            n_waits = test::LaunchCounter::sum(waits);
  test::expect_below("launches of a coupled step", n_launches, 151);
  test::expect_below("waits of a coupled step", n_waits, 11);
  EXPECT_GT(n_launches, 50) << "they are counted";
  EXPECT_GT(n_waits, 5) << "they are counted";
  if (HasFailure()) std::cout << listed(launches) << "\n" << listed(waits) << "\n";
}

}  // namespace

}  // namespace barchan
