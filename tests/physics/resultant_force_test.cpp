// The forces in the output against Newton's second law: without contacts the resultant is what
// changed the grain's momentum over the step, and the parts add up to it.
#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kDiameter = 2e-4;

void expect_newtons_law(const char* what, Config c, double displaced_density) {
  c.grains->gravity = {2, -9.81, 0.5};
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  InitialGrains grain;
  testing::add_grain(grain, kDiameter, {1.3e-3, 3e-3, 2e-3}, {0.04, -0.01, 0.02});
  CoupledRun run(c, grain);
  const double volume = test::volume_of(kDiameter), m = 2500 * volume;
  const double weight = (2500 - displaced_density) * volume * -9.81;
  double worst = 0, worst_parts = 0;
  for (int n = 0; n < 20; ++n) {
    const Vec3 before = run.velocity_of(1);
    run.advance();
    const Vec3 rate = (m / c.time.fluid_step) * (run.velocity_of(1) - before);
    const Vec3 total = test::force_on_first(run, "force_total");
    worst = std::max(worst, norm(total - rate) / norm(rate));
    if (displaced_density == 0) continue;
    const Vec3 mean = testing::host_copy(run.step.mean_resultant_force(*run.state.grains))(0);
    EXPECT_LT(norm(mean - rate), 1e-12 * norm(rate)) << what;
    const double parts = weight + test::force_on_first(run, "force_drag").y +
                         test::force_on_first(run, "force_added_mass").y;
    if (!c.fluid) worst_parts = std::max(worst_parts, std::abs(parts - total.y) / norm(rate));
  }
  testing::expect_below(std::string("resultant force, m du/dt, ") + what, worst, 1e-10);
  testing::expect_below(std::string("its parts, ") + what, worst_parts, 1e-10);
}

TEST(ResultantForce, IsWhatMovesTheGrain) {
  const std::array<double, 3> size{6e-3, 6e-3, 6e-3};
  Config nothing = test::still_water(size);
  nothing.grains->ambient.reset();
  expect_newtons_law("without a fluid", nothing, 0);
  expect_newtons_law("in still water", test::still_water(size), 1000);
  expect_newtons_law("in a computed flow", test::water_box({6, 6, 6}, size), 1000);
}

}  // namespace
}  // namespace barchan
