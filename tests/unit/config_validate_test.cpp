// Keys that are fine alone and wrong together; what is unwise is a warning and runs.
#include "src/config/validate.hpp"

#include <gtest/gtest.h>

#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::grain_case;
using test::Lines;
using test::problems;
using test::refused;
using test::refused_fluid;

/// True when one of the lines has `text` in it.
bool says(const Lines& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

Lines warnings(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Config config = load_config_text(text, "case.toml", overrides);
  return config_warnings(config, known_sizes(config));
}

/// A case with both parts whose cells and steps nothing is said against.
std::string coupled_case() {
  return fluid_case(
      "first_cell_height = 2.625e-4\nmean_velocity = 0.28\n[grains]\nsizes = [[0.2e-3, 100]]\n"
      "[initial]\ngrains = { pour = { centre = [0.05, 0.02], radius = 0.006 } }\n");
}

TEST(ConfigValidate, TheCoupledCaseIsClean) {
  EXPECT_TRUE(problems(coupled_case()).empty());
  EXPECT_EQ(warnings(coupled_case()), Lines{});
}

TEST(ConfigValidate, RayleighLimitsAt20And30PerCentOfTheSmallestGrain) {
  // T_R = 9.444388e-6 s at d = 0.15 mm, glass of the paper: 20 % is 1.8889e-6, 30 % is 2.8333e-6 s.
  // The step taken is a whole part of the fluid step, so that is set to the same.
  const auto with = [](const char* step) {
    return std::vector<std::string>{std::string("time.grain_step=") + step,
                                    std::string("time.fluid_step=") + step, "time.end=0.01",
                                    "output.history_interval=0.01",
                                    "grains.sizes=[[0.2e-3, 10], [0.15e-3, 1]]"};
  };
  EXPECT_FALSE(says(warnings(grain_case(), with("1.88e-6")), "Rayleigh"));
  EXPECT_TRUE(
      says(warnings(grain_case(), with("1.90e-6")), "grain_step is 20.1 % of the Rayleigh time"));
  EXPECT_TRUE(problems(grain_case(), with("2.83e-6")).empty());
  const Lines refused = problems(grain_case(), with("2.84e-6"));
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_EQ(refused[0].find(
                "--set time.grain_step: [time] grain_step = 2.84e-06: must be at most 2.83e-06 s"),
            0u)
      << refused[0];
  // Frozen grains take no steps.
  auto frozen = with("2.84e-6");
  frozen.insert(frozen.end(), {"grains.frozen=true", "initial.grains=none"});
  EXPECT_FALSE(says(problems(grain_case(), frozen), "Rayleigh"));
}

TEST(ConfigValidate, RayleighFractionIsOfTheStepReallyTaken) {
  // 3e-6 alone would be 31.8 % of the smallest; cut into whole parts of 4e-6 it is 2e-6.
  EXPECT_TRUE(problems(grain_case(), {"grains.sizes=[[0.15e-3, 10]]", "time.grain_step=3e-6",
                                      "time.fluid_step=4e-6"})
                  .empty());
}

TEST(ConfigValidate, LinearContactsHaveTheirOwnLimit) {
  // m = 1.0472e-8 kg, k = 10 N/m: contact 7.189e-5 s, a fifth of it 1.4377e-5 s.
  const std::string text = grain_case("contact_model = \"linear\"\nlinear_stiffness = 10\n");
  const auto at = [](const char* step) {
    return std::vector<std::string>{std::string("time.grain_step=") + step,
                                    std::string("time.fluid_step=") + step};
  };
  EXPECT_TRUE(problems(text, at("1.43e-5")).empty());
  EXPECT_TRUE(
      says(problems(text, at("1.45e-5")), "grain_step = 1.45e-05: must be at most 1.44e-05 s"));
}

TEST(ConfigValidate, ContradictionsInTheFluid) {
  refused(fluid_case("mean_velocity = 0.2\npressure_gradient = 10\n"),
          "case.toml:8: [fluid] pressure_gradient = 10: contradicts mean_velocity: give one of the "
          "two");
  refused_fluid("ramp_time = 1", "must be absent without a mean_velocity to bring up");
  refused_fluid("top_velocity = 1", "must come with top = \"no_slip\"");
  refused(fluid_case("[initial]\nfluid = \"turbulent\"\n"),
          "case.toml:8: [initial] fluid = \"turbulent\": must come with a mean_velocity or "
          "pressure_gradient, which sets its log law");
  EXPECT_TRUE(
      problems(fluid_case("pressure_gradient = 10\n[initial]\nfluid = \"turbulent\"\n")).empty());
}

TEST(ConfigValidate, FirstRowFitsTheHeight) {
  refused(fluid_case("first_cell_height = 1e-3\n"),
          "case.toml:7: [fluid] first_cell_height = 0.001: must be at most Ly / ny = 0.0008333 m: "
          "the rows grow from the floor upwards, or are all equal");
  EXPECT_TRUE(problems(fluid_case("first_cell_height = 8.3e-4\n")).empty());
  EXPECT_TRUE(says(warnings(fluid_case("first_cell_height = 1e-5\nkinematic_viscosity = 1e-8\n")),
                   "makes rows grow by"));
}

TEST(ConfigValidate, FluidStepAgainstCflAndViscosity) {
  // dx = 0.1/62 m: 1.15 x 0.28 x dt / dx = 0.5 at dt = 2.5045e-3 s, 1 at 5.009e-3 s.
  const std::string text = fluid_case("mean_velocity = 0.28\n");
  EXPECT_FALSE(says(warnings(text, {"time.fluid_step=2.5e-3"}), "CFL"));
  EXPECT_TRUE(says(warnings(text, {"time.fluid_step=2.51e-3"}), "CFL"));
  EXPECT_TRUE(
      says(problems(text, {"time.fluid_step=5.02e-3"}), "must keep the CFL number below 1"));
  // 4 nu dt (1/dx^2 + 1/dy^2 + 1/dz^2) = 1 at dt = 4.515e-2 s for nu = 2.5e-6 m^2/s.
  const std::string still = fluid_case("kinematic_viscosity = 2.5e-6\n");
  EXPECT_FALSE(says(problems(still, {"time.fluid_step=0.0451"}), "viscosity is explicit"));
  EXPECT_TRUE(says(problems(still, {"time.fluid_step=0.0452"}), "viscosity is explicit"));
}

TEST(ConfigValidate, ContradictionsInTheGrains) {
  EXPECT_TRUE(says(
      problems(grain_case("rolling_friction = 0.1\nrolling_model = \"none\"\n")),
      "case.toml:11: [grains] rolling_model = \"none\": contradicts a rolling_friction above 0"));
  EXPECT_TRUE(says(problems(grain_case("contact_model = \"linear\"\n")),
                   "case.toml:8: [grains] linear_stiffness: must be above 0 with contact_model"));
  EXPECT_TRUE(
      says(problems(grain_case("linear_stiffness = 10\n")), "must be absent unless contact_model"));
  EXPECT_TRUE(says(problems(grain_case("frozen = true\n")), "frozen = true: contradicts pour"));
  EXPECT_TRUE(says(problems(coupled_case() + "[grains.ambient]\n"),
                   "case.toml:13: [grains] ambient = {  }: contradicts [fluid]"));
  EXPECT_TRUE(says(problems(coupled_case(), {"fluid.kinematic_viscosity=0"}), "drag needs it"));
}

TEST(ConfigValidate, StartsThatDoNotBelong) {
  refused(grain_case(),
          "--set initial.fluid: [initial] fluid = \"turbulent\": must be absent without a [fluid] "
          "section",
          {"initial.fluid=turbulent"});
  refused(fluid_case("[initial]\ngrains = { pour = { radius = 0.01 } }\n"),
          "case.toml:8: [initial] grains = { pour = { radius = 0.01 } }: must be absent without a "
          "[grains] section");
  refused(
      fluid_case("[grains]\n"),
      "case.toml: [initial] grains: must say where the [grains] start: a file or { pour = {...} }");
}

TEST(ConfigValidate, PouredConeHasGrainsAndFitsTheDomain) {
  refused(grain_case(), "--set grains.sizes: [grains] sizes = []: must say which grains to pour",
          {"grains.sizes=[]"});
  EXPECT_TRUE(says(
      problems(grain_case(), {"initial.grains.pour.radius=0.021"}),
      "must keep the cone inside the domain; along z it spans -0.001 to 0.041 m of 0 to 0.04 m"));
  EXPECT_FALSE(
      says(problems(grain_case(), {"initial.grains.pour.radius=0.0199"}), "inside the domain"));
  EXPECT_TRUE(
      says(problems(grain_case(), {"initial.grains.pour.drop_height=0.026"}), "above the domain"));
  // 10,000 of 0.25 mm on a lattice of 0.2525 mm: 1.14e-7 m^3, a cone on 2 mm that is 27 mm high.
  const auto on = [](const char* radius) {
    return problems(grain_case(), {"grains.sizes=[[0.25e-3, 10000]]",
                                   std::string("initial.grains.pour.radius=") + radius});
  };
  EXPECT_TRUE(says(on("2.0e-3"), "the cone would reach about 0.0272 m, above the domain"));
  EXPECT_TRUE(on("2.1e-3").empty());
}

TEST(ConfigValidate, StepsFitEachOther) {
  refused(grain_case(),
          "--set time.end: [time] end = 0.0001: must be at least one fluid_step, 0.00025 s",
          {"time.end=1e-4"});
  EXPECT_TRUE(says(problems(grain_case(), {"time.grain_step=1e-3"}),
                   "must be at most fluid_step, 0.00025 s"));
  const Lines steps{"time.fluid_step=1e-3", "output.history_interval=1e-3"};
  EXPECT_TRUE(problems(fluid_case(), {steps[0], steps[1], "time.end=9999999.999"}).empty());
  EXPECT_TRUE(says(problems(fluid_case(), {steps[0], steps[1], "time.end=1e7"}),
                   "which is 9999999999 fluid steps"));
}

TEST(ConfigValidate, WhatIsUnwiseIsWarnedOf) {
  const std::pair<std::string, std::string> unwise[] = {
      {"fluid.first_cell_height=2.3e-4", "makes the smallest cell 1.15 mean grain diameters"},
      {"fluid.first_cell_height=3.3e-4", "makes the smallest cell 1.65 mean grain diameters"},
      {"coupling.smoothing_length=0", "alpha_f is then noisy"},
      {"coupling.smoothing_length=5e-5", "no effect"},
      {"coupling.smoothing_length=7e-3", "smear the dune"},
      {"grains.boundary_x=wall", "boundary_x stops grains"},
      {"grains.skin=3e-4", "skin is above the smallest diameter"},
      {"time.end=1.0001", "the run ends at 1.00025 s"},
      {"output.dune_interval=1e-5",
       "warning: [output] dune_interval is shorter than a fluid step"}};
  for (const auto& [assignment, words] : unwise) {
    EXPECT_TRUE(says(warnings(coupled_case(), {assignment}), words)) << assignment;
  }
  for (const char* wise : {"grains.boundary_x=periodic", "time.end=0.3"}) {
    EXPECT_EQ(warnings(coupled_case(), {wise}), Lines{}) << wise;
  }
}

TEST(ConfigValidate, PeriodicDomainHoldsAGrainAndItsImage) {
  EXPECT_TRUE(says(problems(grain_case(), {"domain.size=[0.1, 0.025, 7.1e-4]"}), "its own image"));
  EXPECT_FALSE(says(problems(grain_case(), {"domain.size=[0.1, 0.025, 7.3e-4]"}), "its own image"));
}

TEST(ConfigValidate, NothingIsConcludedFromAValueThatIsWrong) {
  refused(fluid_case("mean_velocity = 0.2\npressure_gradient = \"x\"\n"),
          "case.toml:8: [fluid] pressure_gradient = \"x\": must be a number");
  EXPECT_EQ(
      problems(fluid_case("[initial]\nfluid = 3\n[fluid.x]\n"), {"fluid.mean_velocity=-1"}).size(),
      4u);
}

TEST(ConfigValidate, ContradictionsComeWithTheOtherProblems) {
  EXPECT_EQ(
      problems(fluid_case("mean_velocity = 0.2\npressure_gradient = 10\nwale_constant = -1\n")),
      (Lines{"case.toml:8: [fluid] pressure_gradient = 10: contradicts mean_velocity: give one of "
             "the two",
             "case.toml:9: [fluid] wale_constant = -1: must be at least 0 and at most 2",
             "2 problems; nothing was run."}));
}

}  // namespace
}  // namespace barchan
