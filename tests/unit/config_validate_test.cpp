// Keys that are fine alone and wrong together; what is unwise is a warning and runs.
#include "src/case/validate.hpp"

#include <gtest/gtest.h>

#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::coupled_case;
using test::fluid_case;
using test::grain_case;
using test::Lines;
using test::problems;
using test::refused;

/// True when one of the lines has `text` in it.
bool says(const Lines& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

Lines warnings(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Case the_case = load_case_text(text, "case.toml", overrides);
  return config_warnings(the_case.config, the_case.sizes);
}

TEST(ConfigValidate, TheCoupledCaseIsClean) {
  EXPECT_TRUE(problems(coupled_case()).empty());
  EXPECT_EQ(warnings(coupled_case()), Lines{});
}

/// Sets both steps to the same value: the grain step taken is a whole part of the fluid step.
Lines steps(const std::string& step, const Lines& others = {}) {
  Lines all{"time.grain_step=" + step, "time.fluid_step=" + step};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

TEST(ConfigValidate, RayleighLimitsAt20And30PerCentOfTheSmallestGrain) {
  // T_R = 9.444388e-6 s at d = 0.15 mm, glass of the paper: 20 % is 1.8889e-6, 30 % is 2.8333e-6 s.
  const std::string text = grain_case();
  const Lines sizes{"grains.sizes=[[0.2e-3, 10], [0.15e-3, 1]]"};
  EXPECT_FALSE(says(warnings(text, steps("1.88e-6", sizes)), "Rayleigh"));
  EXPECT_TRUE(
      says(warnings(text, steps("1.90e-6", sizes)), "grain_step is 20.1 % of the Rayleigh time"));
  EXPECT_TRUE(problems(text, steps("2.83e-6", sizes)).empty());
  EXPECT_TRUE(says(problems(text, steps("2.84e-6", sizes)),
                   "--set time.grain_step = 2.84e-06: must be at most 2.83e-06 s"));
  // Frozen grains take no steps.
  const Lines frozen{sizes[0], "grains.frozen=true", "initial.grains=none"};
  EXPECT_FALSE(says(problems(text, steps("2.84e-6", frozen)), "Rayleigh"));
  // 3e-6 alone would be 31.8 % of the smallest; cut into whole parts of 4e-6 it is 2e-6.
  EXPECT_TRUE(problems(text, {sizes[0], "time.grain_step=3e-6", "time.fluid_step=4e-6"}).empty());
}

TEST(ConfigValidate, LinearContactsHaveTheirOwnLimit) {
  // m = 1.0472e-8 kg, k = 10 N/m: contact 7.189e-5 s, a fifth of it 1.4377e-5 s.
  const std::string text = grain_case("contact_model = \"linear\"\nlinear_stiffness = 10\n");
  EXPECT_TRUE(problems(text, steps("1.43e-5")).empty());
  EXPECT_TRUE(
      says(problems(text, steps("1.45e-5")), "grain_step = 1.45e-05: must be at most 1.44e-05 s"));
}

TEST(ConfigValidate, ContradictionsAreErrorsWithTheirKey) {
  const std::string fluid = fluid_case("mean_velocity = 0.2\n"), still = fluid_case();
  const std::string grains = grain_case(), both = coupled_case();
  const struct {
    std::string text, assignment, words;
  } contradictions[] = {
      {fluid, "fluid.pressure_gradient=10",
       "pressure_gradient = 10: contradicts mean_velocity: give one of the two"},
      {still, "fluid.ramp_time=1",
       "ramp_time = 1: must be absent without a mean_velocity to bring up"},
      {still, "fluid.top_velocity=1", "top_velocity = 1: must come with top = \"no_slip\""},
      {still, "initial.fluid=turbulent",
       "--set initial.fluid = \"turbulent\": must come with a mean_velocity or pressure_gradient, "
       "which sets its log law"},
      {still, "initial.fluid=uniform",
       "--set initial.fluid = \"uniform\": must come with a mean_velocity, which it starts at"},
      {grains, "coupling.forces=[\"drag\"]",
       "--set coupling.forces = [\"drag\"]: must be absent without a [fluid] section"},
      {grains, "coupling.smoothing_length=3e-4", "must be absent without a [fluid] section"},
      {fluid, "coupling.drag=none", "drag = \"none\": must be absent without a [grains] section"},
      {grains, "initial.fluid=turbulent",
       "--set initial.fluid = \"turbulent\": must be absent without a [fluid] section"},
      {still, "initial.grains={ pour = { radius = 0.01 } }",
       "grains = { pour = { radius = 0.01 } }: must be absent without a [grains] section"},
      {still + "[grains]\n", "time.end=1",
       "case.toml: [initial] grains: must say where the [grains] start: a file or { pour = {...} "
       "}"},
      {grains + "rolling_friction = 0.1\n", "grains.rolling_model=none",
       "rolling_model = \"none\": contradicts a rolling_friction above 0"},
      {grains, "grains.contact_model=linear",
       "case.toml:8: [grains] linear_stiffness: must be above 0 with contact_model"},
      {grains, "grains.linear_stiffness=10", "must be absent unless contact_model"},
      {grains, "grains.thinnest_film=1e-3",
       "must be absent unless contact_model = \"hertz_lubricated\""},
      {both, "coupling.scheme=resolved",
       "--set coupling.scheme = \"resolved\": must come with grains.frozen = true where a case has "
       "a "
       "boundary_x other than \"periodic\""},
      {both + "[coupling]\nscheme = \"resolved\"\n", "grains.floor=glued",
       "[coupling] scheme = \"resolved\": must come with grains.frozen = true where a case has a "
       "glued floor"},
      {both + "[coupling]\nscheme = \"resolved\"\n", "coupling.drag=none",
       "--set coupling.drag = \"none\": must be absent with scheme = \"resolved\""},
      {both, "coupling.centred.void_fraction=centre",
       "--set coupling.centred.void_fraction = \"centre\": must be absent unless scheme = "
       "\"centred\""},
      {both + "[coupling]\nscheme = \"centred\"\n", "coupling.smoothed.void_fraction=centre",
       "must be absent unless scheme = \"smoothed\""},
      {both, "coupling.cfdem.smooth_exchange=true", "must be absent unless scheme = \"cfdem\""},
      {grains, "coupling.scheme=centred", "must be absent without a [fluid] section"},
      {both, "grains.ambient={}", "--set grains.ambient = {  }: contradicts [fluid]"},
      {both, "fluid.kinematic_viscosity=0", "drag needs it"},
      {grains, "grains.frozen=true", "frozen = true: contradicts pour"},
      {grains, "grains.sizes=[]", "sizes = []: must say which grains to pour"},
      {grains, "initial.grains.pour.radius=0.021",
       "must keep the cone inside the domain; along z it spans -0.001 to 0.041 m of 0 to 0.04 m"},
      {grains, "initial.grains.pour.drop_height=0.026", "above the domain"},
      {grains, "initial.grains.pour.radius=0", "radius = 0: must be above 0 for a cone"},
      {grains, "initial.grains.pour.shape=\"bed\"", "contradicts shape = \"bed\""},
      {grains, "domain.size=[0.1, 0.025, 7.1e-4]", "its own image"},
      {grains, "time.end=1e-4", "end = 0.0001: must be at least one fluid_step, 0.00025 s"},
      {grains, "time.grain_step=1e-3", "must be at most fluid_step, 0.00025 s"},
      {still, "time.end=3e6", "which is 9999999999 fluid steps"}};
  for (const auto& [text, assignment, words] : contradictions) {
    EXPECT_TRUE(says(problems(text, {"time.fluid_step=2.5e-4", assignment}), words)) << assignment;
  }
  // and what is just allowed
  EXPECT_TRUE(
      problems(fluid_case("pressure_gradient = 10\n"), {"initial.fluid=turbulent"}).empty());
  EXPECT_TRUE(problems(fluid, {"initial.fluid=uniform"}).empty());
  EXPECT_TRUE(problems(grains, {"coupling.drag=gidaspow"}).empty()) << "as a resolved case has it";
  EXPECT_TRUE(problems(grains, {"initial.grains.pour.radius=0.0199"}).empty());
  EXPECT_FALSE(says(problems(grains, {"domain.size=[0.1, 0.025, 7.3e-4]"}), "its own image"));
  EXPECT_TRUE(problems(still, {"time.fluid_step=1e-3", "time.end=9999999.999"}).empty());
}

TEST(ConfigValidate, AFeedAndAWindowThatFollowsAreCheckedTogether) {
  const std::string both = coupled_case() + "[grains.feed]\nrate = 10\nx = 0.002\n";
  const std::string follow = "grains.boundary_x=follow";
  const std::pair<Lines, std::string> wrong[] = {
      {{"grains.feed.rate=0"}, "rate = 0: must be above 0 with amount = \"given\""},
      {{"grains.feed.amount=as_lost", "grains.feed.rate=10"},
       "must be absent with amount = \"as_lost\""},
      {{"grains.feed.amount=as_lost", "grains.feed.rate=0", "grains.boundary_x=periodic"},
       "amount = \"as_lost\": must be \"given\" where no grain leaves"},
      {{"grains.frozen=true"}, "contradicts frozen: grains could not move on"},
      {{"grains.feed.x=0.1"}, "x = 0.1: must lie within the domain, below 0.1 m"},
      {{"grains.feed.x=0.0999"}, "must leave room for the largest grain, 0.0002 m, before the"},
      {{"grains.feed.across=[0.03, 0.01]"}, "must be [from, to] with from below to"},
      {{"grains.feed.across=[0.03, 0.041]"}, "within the width of 0.04 m"},
      {{"grains.feed.height=0.025"}, "must be below the height of the domain, 0.025 m"},
      {{"grains.feed.height=0.0249"}, "must leave room for the largest grain, 0.0002 m, below"},
      {{follow, "grains.feed.x=1e-3"}, "x = 0.001: must be at least a cell, 0.001042 m"},
      {{follow, "grains.feed.x=0.06"}, "x = 0.06: must be at most half the domain, 0.05 m"},
      {{follow, "output.dune_interval=0"}, "must come with an output.dune_interval above 0"},
      {{follow, "fluid.cells=[7, 30, 25]"}, "must come with 8 fluid.cells along x or more"},
      {{follow, "grains.frozen=true"}, "must not be \"follow\" with frozen grains"}};
  for (const auto& [assignments, words] : wrong)
    EXPECT_TRUE(says(problems(both, assignments), words)) << assignments.back();
  EXPECT_TRUE(says(problems(grain_case(), {follow}), "must not be \"follow\" without a [fluid]"));
  EXPECT_TRUE(says(warnings(both, {"grains.feed.start=1"}), "is after the end of the run"));
  for (const Lines& right : {Lines{}, Lines{follow}, Lines{"grains.feed.across=[0, 0.04]"},
                             Lines{"grains.feed.amount=as_lost", "grains.feed.rate=0"}})
    EXPECT_EQ(warnings(both, right), Lines{});
}

TEST(ConfigValidate, KeysThatCanDoNothingAreErrors) {
  const std::string fluid = fluid_case("mean_velocity = 0.2\n"), grains = grain_case();
  const struct {
    std::string text;
    std::vector<std::string> assignments;
    std::string words;
  } idle[] = {
      {grains, {"solver.max_iterations=10"}, "without a [fluid] section"},
      {grains, {"output.fields_interval=1"}, "without a [fluid] section"},
      {fluid, {"time.grain_step=1e-6"}, "without a [grains] section"},
      {fluid, {"output.dune_interval=1"}, "without a [grains] section"},
      {fluid, {"output.grains_interval=0.02"}, "without a [grains] section"},
      {fluid, {"output.tracks_interval=1"}, "without a [grains] section"},
      {fluid, {"output.grain_forces=true"}, "without grains.h5"},
      {grains, {"output.grain_forces=true", "output.grains_interval=0"}, "without grains.h5"},
      {fluid, {"fluid.turbulence=none", "fluid.wale_constant=0.5"}, "unless turbulence = \"wale\""},
      {grains, {"grains.rolling_theta_m=0.2"}, "unless rolling_model = \"theta_m\""},
      {grains,
       {"grains.contact_model=linear", "grains.linear_stiffness=10", "grains.youngs_modulus=1e6"},
       "with contact_model = \"linear\""},
      {grains,
       {"initial.grains.pour.shape=bed", "initial.grains.pour.radius=0",
        "initial.grains.pour.centre=[0.01, 0.02]"},
       "with shape = \"bed\""},
      {coupled_case(),
       {"coupling.forces=[\"buoyancy\"]", "coupling.drag=di_felice"},
       "without \"drag\" in coupling.forces"},
      {grains, {"restart.wall_interval=0", "restart.keep=5"}, "both intervals are 0"},
  };
  for (const auto& [text, assignments, words] : idle)
    EXPECT_TRUE(says(problems(text, assignments), words)) << assignments.back();
  const struct {
    std::string text;
    std::vector<std::string> more;
    std::string words;
  } bed_loads[] = {
      {fluid, {}, "bed_load = true: must be absent without a [grains] section"},
      {coupled_case(), {"grains.frozen=true"}, "must be absent with frozen grains"},
      {coupled_case(), {"grains.gravity=[0, 0, 0]"}, "must come with gravity towards the floor"},
      {coupled_case() + "[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius = 1e-3\n"
                        "centre = [0.05, 0.02]\n",
       {},
       "must be absent with bodies"},
  };
  for (auto [text, assignments, words] : bed_loads) {
    assignments.insert(assignments.end(), {"statistics.start=0", "statistics.bed_load=true"});
    EXPECT_TRUE(says(problems(text, assignments), words)) << words;
  }
  EXPECT_TRUE(problems(coupled_case(), {"statistics.start=0", "statistics.bed_load=true"}).empty());
  // Keys at their defaults, as in a resolved case, and keys that have an effect.
  EXPECT_TRUE(
      problems(grains, {"solver.max_iterations=200", "output.fields_interval=0.5"}).empty());
  EXPECT_TRUE(
      problems(grains, {"grains.rolling_model=theta_m", "grains.rolling_theta_m=0.2"}).empty());
  EXPECT_TRUE(problems(grains, {"restart.interval=1e-3", "restart.keep=5"}).empty());
}

TEST(ConfigValidate, WarnsOfWhatWillDisappoint) {
  const std::string fluid = fluid_case("mean_velocity = 0.2\n"), both = coupled_case();
  EXPECT_TRUE(says(warnings(fluid, {"fluid.cells=[30, 4, 8]"}), "has 4 rows over a no-slip floor"));
  EXPECT_TRUE(says(warnings(fluid_case("mean_velocity = 0.2\n")), "begins without turbulence"));
  EXPECT_EQ(warnings(fluid_case("mean_velocity = 0.2\n"), {"initial.fluid=turbulent"}), Lines{});
  const Lines slow{"initial.fluid=turbulent", "fluid.kinematic_viscosity=3e-4",
                   "time.fluid_step=2.5e-4"};
  EXPECT_TRUE(
      says(warnings(fluid_case("mean_velocity = 0.2\n"), slow), "half of the viscous limit"));
  const Lines laminar{"fluid.turbulence=none", "fluid.kinematic_viscosity=3e-4",
                      "time.fluid_step=2.5e-4"};
  EXPECT_FALSE(says(warnings(fluid_case("mean_velocity = 0.2\n"), laminar), "viscous limit"));
  EXPECT_TRUE(says(warnings(both, {"coupling.forces=[]"}), "the flow does not move the grains"));
  EXPECT_TRUE(
      says(warnings(both, {"grains.density=900", "time.grain_step=1e-6"}), "the grains float"));
  EXPECT_TRUE(says(warnings(both, {"fluid.mean_velocity=0.15"}), "expect no bed load"));
  EXPECT_TRUE(says(warnings(fluid, {"output.history_interval=0", "output.fields_interval=0"}),
                   "leaves nothing but its last state"));
}

// The velocities of report 42: in a Couette flow of a viscous liquid.
TEST(ConfigValidate, ShortStepsInAViscousLiquidPushGrains) {
  const auto text = [](const char* nu, const char* dt, const char* more) {
    return fmt::format(
        "[time]\nend = 1.2\nfluid_step = {}\ngrain_step = 1e-6\n[domain]\nsize = [6e-3, 6e-3, "
        "6e-3]\n[fluid]\ncells = [6, 48, 6]\nturbulence = \"none\"\ntop = \"no_slip\"\n"
        "kinematic_viscosity = {}\ntop_velocity = 0.06\n[grains]\ndensity = 1000.1\nsizes = "
        "[[0.2e-3, 10]]\n[initial]\ngrains = {{ pour = {{ centre = [3e-3, 3e-3], radius = 1e-3 }} "
        "}}\n{}",
        dt, nu, more);
  };
  const char* words = "alpha_time_derivative pushes the grains about";
  EXPECT_TRUE(says(warnings(text("1e-4", "3e-5", "")), words));
  EXPECT_FALSE(says(warnings(text("1e-5", "2.5e-4", "")), words));
  EXPECT_FALSE(says(warnings(text("1e-6", "3e-5", "")), words)) << "grains are slow to follow";
  EXPECT_FALSE(
      says(warnings(text("1e-4", "3e-5", "[coupling]\nalpha_time_derivative = false\n")), words));
}

TEST(ConfigValidate, WhatTheMethodsCannotDoIsRefused) {
  EXPECT_TRUE(
      says(problems(coupled_case(), {"fluid.cells=[96, 1, 25]", "fluid.first_cell_height=0"}),
           "must be at least 2 rows high with grains"));
  EXPECT_TRUE(says(problems(coupled_case(), {"coupling.smoothing_length=0.11"}),
                   "must be at most 0.1 m, the longest side of the domain"));
  EXPECT_TRUE(says(problems(coupled_case(), {"solver.pressure_tolerance=1e-17"}),
                   "must be at least 1e-14 and below 1"));
  const std::string fence =
      "[[body]]\nname = \"f\"\nshape = \"fence\"\nradius = 1e-12\nspacing = 2.1e-12\nlength = "
      "0.005\nheight = 0.002\ncentre = [0.05, 0.02]\n";
  EXPECT_EQ(problems(fluid_case(fence)).front(),
            "case.toml:11: [body.1] spacing = 2.1e-12: must be at least 5e-07 m: a fence has at "
            "most 10000 posts");
  for (const char* name : {"=HYPERLINK(1)", "a,b", "", "a\\nb"})
    EXPECT_TRUE(says(problems(fluid_case(fmt::format(
                         "[[body]]\nname = \"{}\"\nshape = \"sphere\"\nradius = 1e-3\ncentre = "
                         "[0.05, 0.02]\n",
                         name))),
                     "must be one line without"))
        << name;
}

TEST(ConfigValidate, FirstRowFitsTheHeight) {
  refused(fluid_case("first_cell_height = 1e-3\n"),
          "case.toml:7: [fluid] first_cell_height = 0.001: must be at most Ly / ny = 0.0008333 m: "
          "the rows grow from the floor upwards, or are all equal");
  EXPECT_TRUE(problems(fluid_case("first_cell_height = 8.3e-4\n")).empty());
  const std::string thin = "first_cell_height = 5e-4\nuniform_height = ";
  refused(
      fluid_case(thin + "0.016\n"),
      "case.toml:8: [fluid] uniform_height = 0.016: must be lower: 30 of 30 rows are as high as "
      "the first, 0.0005 m, and those above may not shrink");
  EXPECT_TRUE(problems(fluid_case(thin + "0.003\n")).empty());
  refused(fluid_case("uniform_height = 0.01\n"),
          "case.toml:7: [fluid] uniform_height = 0.01: must come with a first_cell_height, the "
          "height of those rows");
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

TEST(ConfigValidate, PouredConeFitsUnderTheTop) {
  // 10,000 of 0.25 mm on a lattice of 0.2525 mm: 1.14e-7 m^3, a cone on 2 mm that is 27 mm high.
  const auto on = [](const std::string& radius) {
    return problems(grain_case(),
                    {"grains.sizes=[[0.25e-3, 10000]]", "initial.grains.pour.radius=" + radius});
  };
  EXPECT_TRUE(says(on("2.0e-3"), "the heap would reach about 0.0272 m, above the domain"));
  EXPECT_TRUE(on("2.1e-3").empty());
}

TEST(ConfigValidate, KeysOfASchemeGoWithIt) {
  const std::string both =
      coupled_case() + "[coupling]\nscheme = \"smoothed\"\nsmoothed.void_fraction = \"centre\"\n";
  EXPECT_TRUE(problems(both).empty());
  EXPECT_TRUE(problems(both, {"coupling.scheme=layered"}).empty());
}

TEST(ConfigValidate, WhatIsUnwiseIsWarnedOf) {
  const std::pair<std::string, std::string> unwise[] = {
      {"fluid.first_cell_height=2.1e-4", "makes the lowest row 1.05 mean grain diameters: too"},
      {"fluid.cells=[64, 30, 25]", "makes cells 7.8 mean grain diameters long: a dune has a step"},
      {"fluid.cells=[96, 30, 101]", "makes cells 1.98 mean grain diameters narrow: below 2 each"},
      {"coupling.scheme=centred", "smallest cell 0.80 mean grain diameters; recommended"},
      {"fluid.first_cell_height=3.2e-5", "rows thinner than a sixth of the largest grain"},
      {"coupling.smoothing_length=0", "alpha_f is then noisy"},
      {"coupling.smoothing_length=3e-5", "no effect"},
      {"coupling.smoothing_length=1.2e-4", "is 0.6 mean grain diameters; with cells below two"},
      {"coupling.smoothing_length=7e-3", "smear the dune"},
      {"initial.fluid=still", "accelerates within one step and throws the grains"},
      {"grains.boundary_x=wall", "boundary_x stops grains"},
      {"grains.skin=3e-4", "skin is above the smallest diameter"},
      {"time.end=1.0001", "the run ends at 1.00025 s"},
      {"output.dune_interval=1e-5", "[output] dune_interval is shorter than a fluid step"},
      {"output.history_interval=1.1",
       "history_interval is longer than the run, 1 s; only the start"},
      {"output.dune_interval=1.1", "dune_interval is longer than the run"},
      {"output.grains_interval=1.1", "grains_interval is longer than the run"},
      {"output.fields_interval=1.1", "fields_interval is longer than the run"},
      {"output.tracks_interval=1.1", "tracks_interval is longer than the run"}};
  for (const auto& [assignment, words] : unwise) {
    EXPECT_TRUE(says(warnings(coupled_case(), {"time.fluid_step=2.5e-4", assignment}), words))
        << assignment;
  }
  for (const char* wise : {"fluid.cells=[96, 30, 99]", "grains.boundary_x=periodic", "time.end=0.3",
                           "output.grains_interval=1"}) {
    EXPECT_EQ(warnings(coupled_case(), {wise}), Lines{}) << wise;
  }
}

TEST(ConfigValidate, NothingIsConcludedFromAValueThatIsWrong) {
  refused(fluid_case("mean_velocity = 0.2\npressure_gradient = \"x\"\n"),
          "case.toml:8: [fluid] pressure_gradient = \"x\": must be a number");
  EXPECT_EQ(problems(fluid_case("[initial]\nfluid = 3\n[fluid.x]\n"), {"fluid.mean_velocity=-2e6"})
                .size(),
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
