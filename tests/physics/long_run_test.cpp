// A million grain steps: no pair is missed, nothing leaks, nothing drifts.
#include <unistd.h>

#include <fstream>
#include <random>
#include <set>
#include <utility>

#include "src/coupling/state_checks.hpp"
#include "src/initial/initial_state.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/grain_cases.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/sanitized.hpp"

namespace barchan {
namespace {

/// Memory that this process holds [bytes].
double resident() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, pages = 0;
  statm >> size >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

struct Pairs {
  std::size_t touching = 0, missed = 0;
};

/// Every pair of grains is looked at; those that touch must be in the list.
Pairs against_all_pairs(const GrainState& s, const PeriodicBox& box) {
  const auto kin = host_copy(s.kin);
  const auto i = host_copy(s.list.i), j = host_copy(s.list.j);
  std::set<std::pair<int, int>> listed;
  for (int p = 0; p < s.list.n_pairs; ++p) listed.insert(std::minmax(i(p), j(p)));
  Pairs pairs;
  for (int a = 0; a < s.n; ++a) {
    for (int b = a + 1; b < s.n; ++b) {
      if (norm(box.nearest_image(kin(a).x - kin(b).x)) >= kin(a).r + kin(b).r) continue;
      ++pairs.touching;
      pairs.missed += listed.contains({a, b}) ? 0 : 1;
    }
  }
  return pairs;
}

/// A heap of 500 grains under a fast flow, around and around in a short channel: 100 grain steps a
/// fluid step.
Config moving_heap() {
  Config c = test::coupled_config();
  c.size = {0.012, 0.006, 0.009};
  c.fluid->cells = {10, 14, 9};
  c.fluid->mean_velocity = 0.35;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->sizes = {{1.5e-4, 50}, {2e-4, 400}, {2.5e-4, 50}};
  c.initial.pour->centre = {0.006, 0.0045};
  c.initial.pour->radius = 0.0027;
  c.time.grain_step = 2.5e-6;
  return c;
}

Real mean_speed(const GrainState& s) {
  const auto kin = host_copy(s.kin);
  Real sum = 0;
  for (int g = 0; g < s.n; ++g) sum += kin(g).u.x;
  return sum / s.n;
}

void a_long_run(std::int64_t grain_steps) {
  const Config config = moving_heap();
  SystemState state = make_initial_state(config, {});
  CoupledStep step(config, state);
  step.start(state);
  const StateChecks checks(config, MPI_COMM_SELF);
  std::mt19937_64 random(7);
  const std::int64_t steps = grain_steps / step.substeps();
  Pairs pairs;
  double ledger_error = 0, given = 0;  // [N s]
  double displacement = 0;             // of a grain along the flow, mean [m]
  double early = 0;
  int looks = 0;
  for (std::int64_t n = 1; n <= steps; ++n) {
    step.advance(state);
    ASSERT_NO_THROW(checks.check(state, step)) << "step " << n;
    given += norm(step.exchange().given_to_grains);
    if (n == steps / 10) early = resident();
    if (random() % 25 != 0) continue;
    ++looks;
    displacement += 25 * config.time.fluid_step * mean_speed(*state.grains);
    const Pairs now = against_all_pairs(*state.grains, step.neighbor_list()->box());
    pairs.touching += now.touching;
    pairs.missed += now.missed;
  }
  const auto& e = step.ledger().entries();
  for (const char* axis : {"_x", "_y", "_z"}) {
    ledger_error += std::abs(e.at(std::string("impulse_taken_from_fluid") + axis) -
                             e.at(std::string("impulse_given_to_grains") + axis));
  }
  const double growth = resident() / early - 1;
  std::printf(
      "[ measured ] %lld grain steps, %lld list rebuilds, %zu pairs seen touching, %zu missed\n",
      static_cast<long long>(grain_steps), static_cast<long long>(step.neighbor_list()->rebuilds()),
      pairs.touching, pairs.missed);
  EXPECT_EQ(pairs.missed, 0u);
  EXPECT_GT(pairs.touching, 100u * static_cast<std::size_t>(looks)) << "a heap has contacts";
  test::expect_below("growth of memory after a tenth of the run", test::kSanitized ? 0 : growth,
                     0.01);
  // Round-off of a step is some 1e-15 of what it exchanges, and is added to sums that grow.
  test::expect_below("ledger, over what was exchanged", ledger_error / given, 1e-13);
  test::expect_below("deposited volume over the grains' - 1", e.at("largest_volume_mismatch"),
                     1e-13);
  EXPECT_EQ(state.grains->n, 500);
  EXPECT_GT(displacement, 0.002 * static_cast<double>(steps) * config.time.fluid_step)
      << "the heap is meant to move";
}

TEST(LongRun, AHundredThousandGrainSteps) { a_long_run(100'000); }
TEST(LongRunNightly, AMillionGrainSteps) { a_long_run(1'000'000); }

}  // namespace
}  // namespace barchan
