// Bodies that leave the flow no way, and the end of a run with such bodies.
#include "src/fluid/passage.hpp"

#include <gtest/gtest.h>

#include "src/base/errors.hpp"
#include "src/bodies/make_bodies.hpp"
#include "src/fluid/domain.hpp"
#include "tests/support/flow_run.hpp"

namespace barchan {
namespace {

constexpr double kHeight = 6e-3;

BodyConfig box(double x, double z, double along, double across, double height = kHeight) {
  return {.name = "box",
          .shape = BodyShape::of<shapes::Box>(),
          .centre = {1e-3 * x, 1e-3 * z},
          .height = height,
          .size = {1e-3 * along, 1e-3 * across}};
}

/// Cells of 1 mm.
Config channel(const std::vector<BodyConfig>& bodies) {
  Config c;
  c.file = "case.toml";
  c.size = {12e-3, kHeight, 6e-3};
  c.fluid.emplace().cells = {12, 6, 6};
  c.bodies = bodies;
  return c;
}

bool passes(const std::vector<BodyConfig>& bodies, int axis) {
  const Config c = channel(bodies);
  return passes(make_bodies(c.bodies, c.size), make_grid(c).on_host(), axis);
}

TEST(Passage, IsLookedForOnTheMesh) {
  EXPECT_TRUE(passes({box(4, 1.5, 2, 3)}, 0));
  EXPECT_FALSE(passes({box(4, 1.5, 2, 3), box(4, 4.5, 2, 3)}, 0));
  EXPECT_TRUE(passes({box(4, 1.5, 2, 3), box(4, 4.5, 2, 3)}, 2));
  EXPECT_FALSE(passes({box(0, 3, 0, 2)}, 2));
  EXPECT_TRUE(passes({box(0, 3, 0, 2)}, 0));
  EXPECT_TRUE(passes({box(4, 1.5, 2, 3), box(8, 4.5, 2, 3)}, 0));  // round both
  EXPECT_FALSE(passes({box(4, 3, 2, 6, 5.5e-3)}, 0));              // half a cell is none
  EXPECT_TRUE(passes({box(4, 3, 2, 6, 5.4e-3)}, 0));
  const BodyConfig post{.name = "post",
                        .shape = BodyShape::of<shapes::Cylinder>(),
                        .centre = {4e-3, 3e-3},
                        .radius = 3e-3,
                        .height = kHeight};
  EXPECT_FALSE(passes({post}, 0));
  const BodyConfig wave{.name = "wave",
                        .shape = BodyShape::of<shapes::Wave>(),
                        .base = 5e-3,
                        .height = 2e-3,
                        .wavelength = 6e-3};
  EXPECT_FALSE(passes({wave}, 0));
}

// Every section has open faces. What comes through the first plate meets the second one.
TEST(Passage, IsNoMatterOfSectionsAlone) {
  const std::vector<BodyConfig> open{box(3, 1.5, 1, 3), box(8, 4.5, 1, 3), box(5.5, 3, 6, 1)};
  EXPECT_TRUE(passes(open, 0));
  std::vector<BodyConfig> closed = open;
  closed.push_back(box(5.5, 0.5, 6, 1));
  EXPECT_FALSE(passes(closed, 0));
}

TEST(Passage, IsAskedOfADrivenFlowAlone) {
  Config c = channel({box(4, 1.5, 2, 3), box(4, 4.5, 2, 3)});
  EXPECT_NO_THROW(check_passage(c));
  c.fluid->mean_velocity = {0, 0.1};
  EXPECT_NO_THROW(check_passage(c));
  c.fluid->mean_velocity = 0.1;
  EXPECT_THROW(check_passage(c), InputError);
  c.fluid->mean_velocity = 0;
  c.fluid->pressure_gradient = 10;
  EXPECT_THROW(check_passage(c), InputError);
}

// Run without a check before it: from still fluid it once came to 4e-15 of 0.2 m/s, and "done".
TEST(Passage, WhereThereIsNoneTheRunEnds) {
  Config c = test::laminar({12, 6, 6}, {12e-3, kHeight, 6e-3}, 1e-6, 1e-6);
  c.bodies = {box(4, 1.5, 2, 3), box(4, 4.5, 2, 3)};
  c.fluid->mean_velocity = 0.2;
  for (const double ramp : {0.0, 1.0}) {
    c.fluid->ramp_time = ramp;
    test::FlowRun run(c);
    run.start_uniform(0);
    EXPECT_THROW(for (int s = 0; s < 40; ++s) run.advance(2.5e-4), StateError) << ramp;
  }
  c.bodies.pop_back();
  c.fluid->ramp_time = 0;
  test::FlowRun run(c);
  run.start_uniform(0);
  for (int s = 0; s < 40; ++s) run.advance(2.5e-4);
  EXPECT_NEAR(run.report.bulk_velocity.x, 0.2, 0.02);
}

}  // namespace
}  // namespace barchan
