// --set reaches every key of a case, and what it says is checked as the file is.
#include <gtest/gtest.h>

#include "src/case/load.hpp"
#include "src/case/resolved.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::grain_case;
using test::refused;

TEST(ConfigOverride, ReplacesAddsAndTakesBareWords) {
  const Config c =
      load_config_text(fluid_case("turbulence = \"wale\"\n"), "case.toml",
                       {"time.end=2.5", "fluid.turbulence=none", "fluid.cells=[8,9,10]",
                        "case.title=Run 7 # odd", "solver.max_iterations=3", "time.end=3"});
  EXPECT_EQ(c.time.end, 3.0);  // the last one counts
  EXPECT_EQ(c.fluid->turbulence, Turbulence::none);
  EXPECT_EQ(c.fluid->cells, (std::array<int, 3>{8, 9, 10}));
  EXPECT_EQ(c.title, "Run 7 # odd");
  EXPECT_EQ(c.solver.max_iterations, 3);
}

TEST(ConfigOverride, ReachesIntoTablesAndMakesSections) {
  const Config c =
      load_config_text(grain_case(), "case.toml",
                       {"initial.grains.pour.radius=0.01", "grains.wall.restitution=0.9",
                        "grains.ambient={density = 900}"});
  EXPECT_EQ(c.initial.pour->radius, 0.01);
  EXPECT_EQ(c.initial.pour->centre[0], 0.05);
  EXPECT_EQ(c.grains->wall.restitution, 0.9);
  EXPECT_EQ(c.grains->ambient->density, 900.0);
}

/// Entries of lists have the numbers that messages and restarts give them, from 1.
TEST(ConfigOverride, ReachesIntoEntriesOfLists) {
  const std::string two = grain_case() +
                          "[[grains.kind]]\nname = \"a\"\n"
                          "[[grains.kind]]\nname = \"b\"\ndensity = 3000\n";
  const Config c = load_config_text(two, "case.toml", {"grains.kind.2.density=2600"});
  ASSERT_EQ(c.grains->kinds.size(), 2U);
  EXPECT_EQ(c.grains->kinds[1].density, 2600.0);
  EXPECT_NE(c.grains->kinds[0].density, 2600.0);
  for (const std::string part : {"3", "0", "-1", "2x", "name"}) {
    refused(two,
            "--set grains.kind." + part + ".density: \"grains.kind\" has no entry " + part +
                ": its entries have the numbers 1 to 2",
            {"grains.kind." + part + ".density=2600"});
  }
  refused(two,
          "--set grains.kind.2.densty: [grains.kind] densty: unknown key (did you mean "
          "\"density\"?)",
          {"grains.kind.2.densty=2600"});
  refused(grain_case(),
          "--set grains.kind.1.density: the case has no list \"grains.kind\": give the whole, "
          "grains.kind=[...]",
          {"grains.kind.1.density=2600"});
}

/// initial.grains is the name of a file or a section.
TEST(ConfigOverride, ReplacesATextByASection) {
  const std::vector<std::string> poured = {"initial.grains=\"heap.csv\"",
                                           "initial.grains.pour.radius=0.01",
                                           "initial.grains.pour.centre=[0.05, 0.01]"};
  EXPECT_EQ(load_config_text(grain_case(), "case.toml", poured).initial.pour->radius, 0.01);
  refused(grain_case(), "--set case.title.x: [case] title = { x = 1 }: must be a string",
          {"case.title=a", "case.title.x=1"});
}

TEST(ConfigOverride, IsCheckedLikeTheFile) {
  refused(fluid_case(), "--set time.end = -1: must be above 0", {"time.end=-1"});
  refused(grain_case(), "--set time.end.x: \"time.end\" is not a section", {"time.end.x=1"});
  refused(grain_case(), "--set time..end: a part of the key is empty", {"time..end=1"});
  refused(grain_case(), "--set time.end: must have the form key=value, as in time.end=2.5",
          {"time.end"});
  refused(grain_case(), "--set : must have the form key=value, as in time.end=2.5", {"=1"});
}

TEST(ConfigOverride, WhatItSwitchesOffIsAsIfItWereNotThere) {
  const std::string text = test::grain_case("youngs_modulus = 1e7\n");
  const std::vector<std::string> linear = {"grains.contact_model=linear",
                                           "grains.linear_stiffness=10"};
  const Config config = load_config_text(text, "case.toml", linear);
  EXPECT_EQ(config.grains->material.youngs_modulus, Material().youngs_modulus);
  EXPECT_EQ(load_config_text(to_toml(config), "case.toml"), config);
  auto both = linear;
  both.emplace_back("grains.youngs_modulus=1e7");
  EXPECT_FALSE(test::problems(text, both).empty());
  EXPECT_FALSE(
      test::problems(text + "contact_model = \"linear\"\nlinear_stiffness = 10\n").empty());
}

}  // namespace
}  // namespace barchan
