// The resolved configuration means the same as the one it came from.
#include "src/config/resolved.hpp"

#include <gtest/gtest.h>

#include "src/config/load.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

Config reloaded(const Config& config) { return load_config_text(to_toml(config), config.file); }

TEST(ConfigResolved, DefaultsComeBack) {
  for (const std::string& text : {test::grain_case(), test::fluid_case()}) {
    const Config config = load_config_text(text, "case.toml");
    EXPECT_EQ(reloaded(config), config) << to_toml(config);
  }
}

/// Every member away from its default, with numbers that need all their digits.
Config unusual() {
  Config c;
  c.file = "case.toml";
  c.title = "Quotes \" and \\ and\na new line, \xc3\xbc";
  c.time = {
      .end = 1.0 / 3, .fluid_step = 1e-4 / 3, .grain_step = 1e-6 / 3, .wall_clock_limit = 3600};
  c.size = {0.1, 0.1 + 0.2, 0.7};
  c.fluid = FluidConfig{.cells = {7, 8, 9},
                        .first_cell_height = 0.01,
                        .density = 998.2,
                        .kinematic_viscosity = 1.004e-6,
                        .mean_velocity = 0,
                        .pressure_gradient = 10.24,
                        .ramp_time = 0,
                        .turbulence = Turbulence::none,
                        .wale_constant = 0.5,
                        .bottom = WallFlow::free_slip,
                        .top = WallFlow::no_slip,
                        .top_velocity = 0.25};
  GrainConfig g;
  g.density = 2650;
  g.material = {1e7, 0.3, 0.9, 0.4, 0.01};
  g.wall = {1e9, 0.2, 0.8, 0.5, 0.02};
  g.coulomb_limit = CoulombLimit::elastic;
  g.rolling_model = RollingModel::theta_m;
  g.rolling_theta_m = 0.2;
  g.contact_model = ContactModel::linear;
  g.linear_stiffness = 12.5;
  g.sizes = {{0.2e-3, 5}, {1e-3 / 3, 7}};
  g.boundary_x = GrainBoundaryX::periodic;
  g.boundary_z = GrainBoundaryZ::wall;
  g.gravity = {0.1, -9.7, 0.2};
  g.skin = 1e-5;
  g.max_overlap = 0.25;
  c.grains = g;
  c.coupling = {DragLaw::koch_hill,
                VoidFraction::centre,
                1e-3,
                false,
                false,
                {true, false, true, false, true}};
  c.initial.fluid = "turbulent";
  c.initial.seed = 9;
  c.initial.pour = PourConfig{{0.04, 0.3}, 0.02, 0.001, 77};
  c.output = {0.1, 0.2, 0.3, 0.4, 0.05, true};
  c.restart = {0.5, 60, 4};
  c.statistics = {0.15, 0.02, true, true};
  c.solver = {1e-8, 50, 2, Preconditioner::jacobi};
  return c;
}

TEST(ConfigResolved, EveryMemberComesBack) {
  const Config c = unusual();
  const Config back = reloaded(c);
  EXPECT_EQ(back.title, c.title);
  EXPECT_EQ(back.time, c.time);
  EXPECT_EQ(back.size, c.size);
  EXPECT_EQ(back.fluid, c.fluid);
  EXPECT_EQ(back.grains, c.grains);
  EXPECT_EQ(back.coupling, c.coupling);
  EXPECT_EQ(back.initial, c.initial);
  EXPECT_EQ(back.output, c.output);
  EXPECT_EQ(back.statistics, c.statistics);
  EXPECT_EQ(back.restart, c.restart);
  EXPECT_EQ(back.solver, c.solver);
  EXPECT_EQ(back, c) << to_toml(c);
}

TEST(ConfigResolved, FrozenAndAmbientComeBack) {
  Config c = load_config_text(test::grain_case("[grains.ambient]\ndensity = 870\n"), "case.toml");
  EXPECT_EQ(reloaded(c), c);
  c.grains->ambient.reset();
  EXPECT_EQ(reloaded(c), c);
  EXPECT_NE(reloaded(c), load_config_text(test::grain_case("[grains.ambient]\n"), "case.toml"));
}

TEST(ConfigResolved, EveryKeyIsWritten) {
  // The text of a default case names each key that the loader knows: no default stays unsaid.
  const std::string text = to_toml(unusual());
  for (const char* key : {"title", "end", "wall_clock_limit", "size", "cells", "pressure_gradient",
                          "skin", "max_overlap", "rolling_theta_m", "forces", "drop_height",
                          "grain_forces", "keep", "correctors"}) {
    EXPECT_NE(text.find(std::string("\n") + key + " = "), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace barchan
