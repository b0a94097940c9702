// The bulk velocity that a case wants in time: its formula, its keys, and what they must not say.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/case/derived.hpp"
#include "src/case/resolved.hpp"
#include "src/case/validate.hpp"
#include "src/fluid/flow_schedule.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using namespace test;
using Schedule = std::vector<FlowTarget>;

void expect_velocity(const PlaneVelocity& is, double x, double z) {
  EXPECT_NEAR(is.x, x, 1e-15);
  EXPECT_NEAR(is.z, z, 1e-15);
}

TEST(FlowSchedule, OfAMeanVelocityIsOneEntry) {
  FluidConfig fluid;
  EXPECT_TRUE(flow_schedule(fluid).empty());
  expect_velocity(wanted_velocity({}, {0.1, 0.2}, 1), 0, 0);
  fluid.mean_velocity = {0.3, -0.1};
  fluid.ramp_time = 2;
  const Schedule one = flow_schedule(fluid);
  EXPECT_EQ(one, (Schedule{{.velocity = {0.3, -0.1}, .ramp = 2}}));
  expect_velocity(wanted_velocity(one, {0.1, 0}, 0), 0.1, 0);
  expect_velocity(wanted_velocity(one, {0.1, 0}, 0.5), 0.15, -0.025);
  expect_velocity(wanted_velocity(one, {0.1, 0}, 5), 0.3, -0.1);
  fluid.pressure_gradient = 1;
  EXPECT_TRUE(flow_schedule(fluid).empty());
}

TEST(FlowSchedule, RampsFromWhatItWas) {
  const Schedule turn{{.time = 0, .velocity = 0.2},
                      {.time = 1, .velocity = {0, 0.4}, .ramp = 2},
                      {.time = 3, .velocity = 0, .ramp = 1},
                      {.time = 7, .velocity = -0.2}};
  const auto at = [&](double t) { return wanted_velocity(turn, {0.3, 0.1}, t); };
  expect_velocity(at(0), 0.2, 0);
  expect_velocity(at(1), 0.2, 0);
  expect_velocity(at(1.5), 0.15, 0.1);
  expect_velocity(at(3), 0, 0.4);
  expect_velocity(at(3.25), 0, 0.3);
  expect_velocity(at(6.9), 0, 0);
  expect_velocity(at(7), -0.2, 0);
  expect_velocity(at(100), -0.2, 0);
  EXPECT_TRUE(goes_across(turn));
  EXPECT_FALSE(goes_across(Schedule{{.velocity = 0.2}}));
  EXPECT_TRUE(goes_across(Schedule{{.amplitude = {0, 0.1}, .period = 1}}));
}

TEST(FlowSchedule, AddsASineAndGoesOnFromIt) {
  const Schedule swings{
      {.velocity = 0.1, .amplitude = {0.2, -0.3}, .period = 4},
      {.time = 5, .velocity = {0.5, 0}, .ramp = 2, .amplitude = {0.1, 0}, .period = 0.8}};
  const auto at = [&](double t) { return wanted_velocity(swings, {}, t); };
  expect_velocity(at(0), 0.1, 0);
  expect_velocity(at(0.5), 0.1 + 0.2 * std::numbers::sqrt2 / 2, -0.3 * std::numbers::sqrt2 / 2);
  expect_velocity(at(3), -0.1, 0.3);
  // The sine is at its peak at 5 s: from there the ramp begins, and a sine of its own.
  expect_velocity(at(5), 0.3, -0.3);
  expect_velocity(at(5.2), 0.3 + 0.2 / 10 + 0.1, -0.3 + 0.3 / 10);
  expect_velocity(at(8), 0.5 - 0.1, 0);
}

TEST(FlowSchedule, TheLargestSpeedSetsWhatFollows) {
  Config c = load_config_text(fluid_case("[[fluid.schedule]]\ntime = 0\nvelocity = 0.1\n"
                                         "[[fluid.schedule]]\ntime = 0.5\nvelocity = [0.3, -0.4]\n"
                                         "ramp = 0.1\namplitude = [0.06, 0.08]\nperiod = 0.2\n"),
                              "case.toml", {"time.fluid_step=2.5e-4"});
  FluidNumbers n = *derive(c, {}).fluid;
  EXPECT_NEAR(n.bulk_velocity, 0.6, 1e-15);
  EXPECT_NEAR(n.u_star, friction_velocity(0.6, 0.025, 1e-6), 1e-15);
  EXPECT_NEAR(n.cfl, 1.15 * 2.5e-4 * (0.36 / (0.1 / 62) + 0.48 / (0.04 / 25)), 1e-12);
  EXPECT_TRUE(n.varies);
  c.fluid->schedule.clear();
  c.fluid->mean_velocity = {0.3, 0.4};
  n = *derive(c, {}).fluid;
  EXPECT_NEAR(n.bulk_velocity, 0.5, 1e-15);
  EXPECT_FALSE(n.varies);
}

/// A case with two entries, the words of which follow.
std::string with(const std::string& first, const std::string& second) {
  return fluid_case("[[fluid.schedule]]\n" + first + "\n[[fluid.schedule]]\n" + second + "\n");
}

TEST(FlowSchedule, IsReadWrittenAndComparedAtARestart) {
  const std::string text = with("time = 0\nvelocity = 0.2",
                                "time = 0.5\nvelocity = [0, -0.2]\n"
                                "ramp = 0.1\namplitude = [0.01, 0.02]\nperiod = 0.3");
  const Config c = load_config_text(text, "case.toml");
  const Schedule expected{
      {.velocity = 0.2},
      {.time = 0.5, .velocity = {0, -0.2}, .ramp = 0.1, .amplitude = {0.01, 0.02}, .period = 0.3}};
  EXPECT_EQ(c.fluid->schedule, expected);
  EXPECT_EQ(load_config_text(to_toml(c), "again.toml").fluid->schedule, expected);
  Config later = c;
  later.fluid->schedule.back().velocity = 0.3;
  EXPECT_TRUE(restart_conflicts(later, c).empty());
  EXPECT_EQ(changed_keys(later, c),
            (Lines{"fluid.schedule.velocity 0.2, [0.0, -0.2] -> 0.2, 0.3"}));
  EXPECT_EQ(load_config_text(fluid_case(), "case.toml",
                             {"fluid.schedule=[{time = 0, velocity = [0.1, 0.1]}]"})
                .fluid->schedule,
            (Schedule{{.velocity = {0.1, 0.1}}}));
}

TEST(FlowSchedule, WhatItMustNotSayIsTold) {
  const std::string from = "time = 0\nvelocity = 0.2";
  const struct {
    std::string first, second, words;
  } mistakes[] = {
      {"time = 0.1\nvelocity = 0.2", "time = 0.5\nvelocity = 0.1\nramp = 0.1",
       "must begin with an entry of time 0; the first is at 0.1 s"},
      {from, "time = 0\nvelocity = 0.1",
       "must be in order of time: entry 2 is at 0 s, the one before at 0 s"},
      {from + "\nramp = 0.6", "time = 0.5\nvelocity = 0.1\nramp = 0.1",
       "must end the ramp of entry 1 at the time of the next, 0.5 s; it lasts until 0.6 s"},
      {from + "\namplitude = 0.1", "time = 0.5\nvelocity = 0.1",
       "must have a period above 0 in entry 1, which has an amplitude"},
      {from, "time = 0.5\nvelocity = 0.1\nperiod = 1",
       "must have no period in entry 2, which has no amplitude"},
      {from + "\namplitude = 0.1\nperiod = 2.4e-3", "time = 0.5\nvelocity = 0.1",
       "must have a period of at least 0.0025 s, 10 fluid steps, in entry 1"},
      {from, "time = 0.5\nvelocity = 2e6", "must be at least -1e+06 and at most 1e+06"},
      {from, "time = 0.5", "case.toml:10: [fluid.schedule] velocity: required key is missing"},
      {from, "velocity = 0.5", "case.toml:10: [fluid.schedule] time: required key is missing"},
      {from, "time = 0.5\nvelocity = [1, 2, 3]",
       "must be a number, along x, or [along x, along z]"},
      {from, "time = 0.5\nvelocity = 0.1\nspeed = 3", "[fluid.schedule] speed: unknown key"},
      {from, "time = 0.5\nvelocity = 20", "must keep the CFL number below 1"}};
  for (const auto& [first, second, words] : mistakes) {
    const Lines lines = problems(with(first, second), {"time.fluid_step=2.5e-4"});
    ASSERT_EQ(lines.size(), 2u) << words;
    EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
  }
  const std::string entry = "[[fluid.schedule]]\ntime = 0\nvelocity = 0.1\n";
  const auto says = [](const Lines& lines, const std::string& words) {
    return lines.size() == 2 && lines[0].find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(problems(fluid_case("mean_velocity = 0.1\n" + entry)),
                   "contradicts mean_velocity: give one of the two"));
  EXPECT_TRUE(says(problems(fluid_case("pressure_gradient = 0.1\n" + entry)),
                   "contradicts pressure_gradient: give one of the two"));
  EXPECT_TRUE(says(problems(fluid_case("ramp_time = 0.1\n" + entry)),
                   "must be absent without a mean_velocity to bring up"));
  for (const char* start : {"turbulent", "uniform"}) {
    const Lines set{std::string("initial.fluid=") + start};
    EXPECT_TRUE(
        problems(with("time = 0\nvelocity = [0, 0.1]", "time = 0.5\nvelocity = 0\nramp = 1"), set)
            .empty())
        << start;
    EXPECT_TRUE(
        says(problems(with("time = 0\nvelocity = 0", "time = 0.5\nvelocity = 1\nramp = 1"), set),
             "; the schedule begins at rest"))
        << start;
  }
}

TEST(FlowSchedule, WhatIsUnwiseIsWarnedOf) {
  const auto warnings = [](const std::string& second) {
    return config_warnings(load_config_text(with("time = 0\nvelocity = 0.2", second), "case.toml"),
                           {});
  };
  EXPECT_EQ(warnings("time = 0.5\nvelocity = 0.1\nramp = 0.1"), Lines{});
  EXPECT_EQ(warnings("time = 0.5\nvelocity = 0.1"),
            (Lines{"[fluid] schedule changes the flow in one step in entry 2: the pressure that "
                   "does it pushes grains as well; give it a ramp"}));
  EXPECT_EQ(warnings("time = 1.0\nvelocity = 0.1\nramp = 0.1"),
            (Lines{"[fluid] schedule has entry 2 at 1 s, after the end of the run"}));
  EXPECT_EQ(warnings("time = 0.5\nvelocity = 0.1\n[[fluid.schedule]]\ntime = 0.6\nvelocity = 0.2"),
            (Lines{"[fluid] schedule changes the flow in one step in entry 2 and 1 more: the "
                   "pressure that does it pushes grains as well; give it a ramp"}));
}

// A measured series. With a copy of the case for each entry it took 22 GB.
TEST(FlowSchedule, MayBeLong) {
  constexpr int kEntries = 20000;
  std::string text = fluid_case();
  for (int n = 0; n < kEntries; ++n)
    text += fmt::format("[[fluid.schedule]]\ntime = {}e-6\nvelocity = 0.{}\n", n, 1 + n % 2);
  const Config config = load_config_text(text, "case.toml");
  ASSERT_EQ(config.fluid->schedule.size(), std::size_t{kEntries});
  Config other = config;
  other.fluid->schedule.back().velocity = 0.3;
  EXPECT_EQ(changed_keys(other, config).size(), 1u);
  EXPECT_EQ(config_as_written(to_toml(config), "case.toml"), config);
  EXPECT_EQ(config_warnings(config, {}).size(), 1u);
}

}  // namespace
}  // namespace barchan
