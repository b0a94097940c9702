// Every way a configuration file can be wrong is said with its line, its key and what is allowed.
#include "src/case/load.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "src/base/words.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::coupled_case;
using test::fluid_case;
using test::grain_case;
using test::Lines;
using test::only;
using test::problems;
using test::refused;
using test::refused_fluid;
using test::refused_grains;

TEST(ConfigLoad, ReadsWhatIsWrittenAndKeepsOtherDefaults) {
  const Config c = load_config_text(
      grain_case("restitution = 0.4\nrolling_model = \"cdt\"\ngravity = [1, -9, 0.5]\n"
                 "frozen = false\n[case]\ntitle = \"A case\"\n[restart]\nkeep = 3\n"),
      "case.toml");
  EXPECT_EQ(c.title, "A case");
  EXPECT_EQ(c.file, "case.toml");
  EXPECT_FALSE(c.fluid.has_value());
  ASSERT_TRUE(c.grains.has_value());
  EXPECT_EQ(c.grains->material.restitution, 0.4);
  EXPECT_EQ(c.grains->material.sliding_friction, Material{}.sliding_friction);
  EXPECT_EQ(c.grains->rolling_model, RollingModel::of<ConstantTorque>());
  EXPECT_EQ(c.grains->gravity, (std::array<double, 3>{1, -9, 0.5}));
  EXPECT_EQ(c.grains->sizes, (std::vector<SizeClass>{{0.2e-3, 100}}));
  EXPECT_EQ(c.restart.keep, 3);
  ASSERT_TRUE(c.initial.pour.has_value());
  EXPECT_EQ(c.initial.pour->radius, 0.006);
  EXPECT_EQ(c.initial.pour->seed, HeapConfig{}.seed);
}

TEST(ConfigLoad, WallTakesTheGrainsMaterialUnlessItNamesItsOwn) {
  const Config c =
      load_config_text(grain_case("[grains.wall]\nyoungs_modulus = 1e9\n[grains.ambient]\n"),
                       "case.toml", {"grains.sliding_friction=0.2"});
  EXPECT_EQ(c.grains->wall.youngs_modulus, 1e9);
  EXPECT_EQ(c.grains->wall.sliding_friction, 0.2);
  EXPECT_EQ(c.grains->material.youngs_modulus, Material{}.youngs_modulus);
  ASSERT_TRUE(c.grains->ambient.has_value());
  EXPECT_EQ(*c.grains->ambient, AmbientConfig{});
}

TEST(ConfigLoad, ForcesAreThoseNamed) {
  const Config c = load_config_text(
      coupled_case() + "[coupling]\nforces = [\"drag\", \"stress\"]\n", "case.toml");
  EXPECT_EQ(c.coupling.forces, (ForceSwitches{true, false, true, false, false}));
  const auto named = [](const std::string& set) {
    return load_config_text(coupled_case(), "case.toml", {"coupling.forces=" + set})
        .coupling.forces;
  };
  EXPECT_EQ(named("paper"), ForceSwitches{});
  EXPECT_EQ(named("complete"),
            (ForceSwitches{true, true, true, true, true, true, true, true, true}));
  refused(fluid_case("[coupling]\nforces = \"complet\"\n"),
          "case.toml:8: [coupling] forces = \"complet\": must be an array of names, or one of "
          "\"paper\", \"complete\" (did you mean \"complete\"?)");
  refused(fluid_case("[coupling]\nforces = [\"drag\", \"strss\"]\n"),
          "case.toml:8: [coupling] forces = [\"drag\", \"strss\"]: must be an array; \"strss\" "
          "must be one of \"drag\", \"pressure_gradient\", \"stress\", \"added_mass\", "
          "\"buoyancy\", \"lift\", \"torque\", \"wall_drag\", \"mixture_viscosity\" (did you mean "
          "\"stress\"?)");
}

TEST(ConfigLoad, UnknownKeyNamesTheNearest) {
  refused(grain_case("restitutoin = 0.5\n"),
          "case.toml:10: [grains] restitutoin: unknown key (did you mean \"restitution\"?)");
  refused(grain_case("zzzzzz = 0.5\n"), "case.toml:10: [grains] zzzzzz: unknown key");
  refused(grain_case("cells = [1, 1, 1]\n"),
          "case.toml:10: [grains] cells: unknown key (did you mean \"cells\" of [fluid]?)");
  refused("zzzzzz = 1\n" + grain_case(), "case.toml:1: zzzzzz: unknown key");
}

TEST(ConfigLoad, UnknownSectionNamesTheNearest) {
  refused(grain_case("[outptu]\nkeep = 1\n"),
          "case.toml:10: [outptu]: unknown section (did you mean \"output\"?)");
  refused(grain_case("[grains.wal]\nrestitution = 0.1\n"),
          "case.toml:10: [grains] wal: unknown key (did you mean \"wall\"?)");
  refused("restart = 2\n" + grain_case(), "case.toml:1: restart = 2: must be a section, [restart]");
}

TEST(ConfigLoad, WrongTypesAreNamed) {
  EXPECT_EQ(load_config_text(grain_case("density = 2650\n"), "case.toml").grains->density, 2650.0);
  refused_grains("density = \"heavy\"", "must be a number");
  refused_grains("frozen = 1", "must be true or false");
  refused_grains("gravity = [0, -9.81]", "must be an array of 3 numbers");
  refused_fluid("top = 3", "must be one of \"no_slip\", \"free_slip\"");
  refused_fluid("turbulence = \"wail\"",
                "must be one of \"none\", \"wale\" (did you mean \"wale\"?)");
  for (const std::string number : {"nan", "inf", "-inf"}) {
    refused_fluid("mean_velocity = " + number, "must be a finite number");
  }
  refused("case.title = 2001-02-03\n" + fluid_case(),
          "case.toml:1: [case] title = 2001-02-03: must be a string");
  for (const std::string keep :
       {"2.0: must be an integer", "3000000000: must be an integer up to 2147483647"}) {
    refused("restart.keep = " + keep.substr(0, keep.find(':')) + "\n" + fluid_case(),
            "case.toml:1: [restart] keep = " + keep);
  }
}

TEST(ConfigLoad, SizesAreDiametersAndCounts) {
  const std::string set = "--set grains.sizes = ";
  refused(
      grain_case(),
      set +
          "[[0.0002, 2147483647], [0.0003, 1]]: must be sizes of at most 2147483647 grains in all",
      {"grains.sizes=[[2e-4, 2147483647], [3e-4, 1]]"});
  refused(grain_case(),
          set +
              "[[0.0002, 10], [0.0002, 0]]: must be an array of [diameter in m above 0, count "
              "above 0]; [0.0002, 0] is not",
          {"grains.sizes=[[2e-4, 10], [2e-4, 0]]"});
}

TEST(ConfigLoad, LimitsAreInclusiveOrNotAsTheySay) {
  refused_grains("poisson_ratio = 2.0", "must be at least 0 and at most 0.5");
  refused_grains("restitution = 0", "must be above 0 and at most 1");
  refused_grains("density = 1e+300", "must be at least 1e-06 and at most 1e+09");
  EXPECT_TRUE(problems(grain_case("restitution = 1\npoisson_ratio = 0\n")).empty());
  refused(fluid_case(), "--set fluid.cells = [62, 0, 25]: must be at least 1 and at most 100000",
          {"fluid.cells=[62, 0, 25]"});
}

TEST(ConfigLoad, MissingRequiredKeysAndSections) {
  EXPECT_EQ(problems("[time]\nfluid_step = 1e-4\n[domain]\n[fluid]\n"),
            (Lines{"case.toml:1: [time] end: required key is missing",
                   "case.toml:3: [domain] size: required key is missing",
                   "case.toml:4: [fluid] cells: required key is missing",
                   "3 problems; nothing was run."}));
  EXPECT_EQ(
      problems("[fluid]\ncells = [8, 8, 8]\n"),
      (Lines{"case.toml: [time]: required section is missing",
             "case.toml: [domain]: required section is missing", "2 problems; nothing was run."}));
  refused("[time]\nend = 1.0\n[domain]\nsize = [1, 1, 1]\n",
          "case.toml: [fluid]: required, or [grains]: without both there is nothing to run");
}

TEST(ConfigLoad, AllProblemsAtOnceInTheOrderOfLines) {
  const std::string text = grain_case(
      "poisson_ratio = 2.0\ndensity = true\n\n[solver]\npreconditioner = \"ft\"\nspeed = 9\n");
  EXPECT_EQ(
      problems(text, {"time.ende=3", "output.grain_forces=yes"}),
      (Lines{
          "case.toml:10: [grains] poisson_ratio = 2.0: must be at least 0 and at most 0.5",
          "case.toml:11: [grains] density = true: must be a number",
          "case.toml:14: [solver] preconditioner = \"ft\": must be one of \"fft\", \"local_fft\" "
          "(did you mean \"fft\"?)",
          "case.toml:15: [solver] speed: unknown key (did you mean \"seed\" of [grains.feed]?)",
          "--set output.grain_forces = \"yes\": must be true or false",
          "--set time.ende: unknown key (did you mean \"end\"?)", "6 problems; nothing was run."}));
}

TEST(ConfigLoad, WhatIsNoTomlIsToldWithItsLine) {
  const auto says = [](const std::string& text, const std::string& words) {
    const Lines lines = problems(text);
    ASSERT_EQ(lines.size(), 2u) << text.substr(0, 100);
    EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
  };
  says("\xFF\xFE[", "case.toml:1: not TOML: ");
  says(std::string("[time]\ne\0nd = 1\n", 16), "case.toml:2: not TOML: it holds a NUL byte");
  says("[time]\nend = 1.0\nend = = 2\n", "case.toml:3: not TOML: ");
  says(fluid_case("cells = [8, 8, 8]\n"), "case.toml:7: not TOML: ");
  says("[case]\ntitle = \"no end\n[time]\nend = 1\n",
       "case.toml:2: not TOML: the quotation mark that ends a text is missing on this line");
  says("[time]\nend = 0,5\n", "decimals take a point, as in 0.25");
  says("[case]\ntitle = \"a\"\n[study]\nbase = \"b.toml\"\n",
       "case.toml:3: [study]: this is a study, not a case: ./barchan sweep case.toml");
  for (const char* value : {"0,5", ".5", "5d-1", "5 s", "True", "\"C:\\q\""}) {
    says(std::string("[time]\nend = ") + value + "\n", "case.toml:2: not TOML: ");
  }
  std::string deep = "a";
  for (int n = 0; n < 100000; ++n) deep += ".a";
  says(deep + " = 1\n", "case.toml:1: not TOML: a key of so many parts");
  says("[" + deep + "]\n", "case.toml:1: not TOML: a key of so many parts");
  EXPECT_EQ(problems(fluid_case(), {deep + "=1"}).size(), 2u);
  // Points in values, strings and comments join no keys.
  EXPECT_TRUE(problems(fluid_case("[case]\ntitle = \"......................\"\n"
                                  "# ......................\n"),
                       {"fluid.mean_velocity=0.1"})
                  .empty());
}

TEST(ConfigLoad, ATitleIsText) {
  refused("case.title = \"a\\u001Bb\"\n" + fluid_case(),
          "case.toml:1: [case] title = \"a\\u001Bb\": must be text without control characters");
  EXPECT_EQ(problems("case.title = \"" + std::string(201, 'a') + "\"\n" + fluid_case()).size(), 2u);
  EXPECT_TRUE(problems("case.title = \"D\xC3\xBCne\"\n" + fluid_case()).empty());
}

TEST(ConfigLoad, OnlySoManyProblemsAreTold) {
  std::string many = fluid_case();
  for (int n = 0; n < 1000; ++n) many += "key_" + std::to_string(n) + " = 1\n";
  const Lines lines = problems(many);
  ASSERT_EQ(lines.size(), 32u);
  EXPECT_EQ(lines[30], "  ... and 970 more");
  EXPECT_EQ(lines[31], "1000 problems; nothing was run.");
}

/// Cases in a folder of their own, for what names other files.
class ConfigStart : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  static Lines load(const std::string& path, const Lines& overrides = {}) {
    return test::lines_of([&] { load_config(path, overrides); });
  }
  const TemporaryFolder folder_;
};

const std::string moved = "[time]\nend = 1\n[domain]\nsize = [0.1, 0.025, 0.04]\n[grains]\n";

TEST_F(ConfigStart, PathsAreRelativeToTheFileAndMustExist) {
  std::filesystem::create_directory(folder_ / "inner");
  write("heap.csv", "id,diameter,x,y,z\n");
  const std::string path =
      write("inner/case.toml", moved + "[initial]\ngrains = \"../heap.csv\"\n");
  EXPECT_EQ(load_config(path).initial.grains, (folder_ / "heap.csv").string());
  const auto told = [&](const std::string& start, const std::string& why) {
    EXPECT_EQ(load(path, {"initial.grains=" + start}), only("--set initial.grains = " + why));
  };
  told("../pile.csv", "\"../pile.csv\": must be a file that exists; there is no " +
                          (folder_ / "pile.csv").string());
  told("../heap.txt",
       "\"../heap.txt\": must be a file ending in .csv, .h5, .toml, or { pour = {...} }");
  told("{}", "{  }: must say where the [grains] start: a file or { pour = {...} }");
}

TEST_F(ConfigStart, FluidStartIsAWordOrAFile) {
  const std::string path =
      write("case.toml", fluid_case("mean_velocity = 0.2\n[initial]\nfluid = \"turbulant\"\n"));
  EXPECT_EQ(load(path),
            only(path + ":9: [initial] fluid = \"turbulant\": must be \"still\", \"uniform\", "
                        "\"turbulent\" or a file ending in .h5, .toml"));
  EXPECT_EQ(load_config(path, {"initial.fluid=uniform"}).initial.fluid, "uniform");
  EXPECT_EQ(load_config(path, {"initial.fluid=turbulent"}).initial.fluid, "turbulent");
}

TEST_F(ConfigStart, ACaseItStartsFromIsCheckedToo) {
  const std::string heap = write("heap.toml", grain_case("restitution = 3\n"));
  const std::string path =
      write("case.toml", moved + "density = 0\n[initial]\ngrains = \"heap.toml\"\n");
  EXPECT_EQ(load(path),
            (Lines{path + ":6: [grains] density = 0: must be at least 1e-06 and at most 1e+09",
                   heap + ":10: [grains] restitution = 3: must be above 0 and at most 1",
                   "2 problems; nothing was run."}));
}

TEST_F(ConfigStart, SizesComeFromTheCaseItStartsFrom) {
  write("heap.toml", grain_case());
  const std::string path = write("case.toml", moved + "[initial]\ngrains = \"heap.toml\"\n");
  const Config c = load_config(path);
  EXPECT_TRUE(c.grains->sizes.empty());
  EXPECT_EQ(load_case(path).sizes, (std::vector<SizeClass>{{0.2e-3, 100}}));
  EXPECT_DOUBLE_EQ(load_config(path, {"grains.skin=0.1 d"}).grains->skin, 0.2e-4);
  // and a grain step too long for those sizes is an error of this case
  const Lines lines = load(path, {"time.grain_step=1e-4"});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("Rayleigh"), std::string::npos) << lines[0];
}

TEST_F(ConfigStart, DiametersInATableAreNotKnown) {
  write("heap.csv", "id,diameter,x,y,z\n");
  const std::string path =
      write("case.toml", moved + "skin = \"0.1 d\"\n[initial]\ngrains = \"heap.csv\"\n");
  EXPECT_EQ(load(path), only(path + ":6: [grains] skin = \"0.1 d\": must be in metres: diameters "
                                    "are known only of grains that are poured, in this case or in "
                                    "the one it starts from"));
  // [grains] sizes says nothing of a table; a start that cannot be read says nothing either.
  EXPECT_EQ(load(path, {"grains.sizes=[[2e-4, 10]]"}).size(), 2u);
  write("heap.toml", grain_case("restitution = 3\n"));
  EXPECT_EQ(load(path, {"initial.grains=heap.toml"}).size(), 2u);
}

TEST_F(ConfigStart, ChainMustNotBeACircleAndMustFit) {
  const std::string one = write("one.toml", fluid_case("[initial]\nfluid = \"two.toml\"\n"));
  const std::string two = write("two.toml", fluid_case("[initial]\nfluid = \"one.toml\"\n"));
  EXPECT_EQ(load(one),
            only(two + ":8: [initial] fluid = \"one.toml\": must not lead back to this case"));
  write("two.toml",
        "[time]\nend = 1\n[domain]\nsize = [0.1, 0.025, 0.05]\n[fluid]\ncells = [62, 30, 24]\n");
  const Lines both = load(one);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NE(both[0].find("must have the same domain; its size is [0.1, 0.025, 0.05] m"),
            std::string::npos);
  write("two.toml", fluid_case("first_cell_height = 1e-4\n"));
  EXPECT_TRUE(load(one).empty()) << "another mesh of the same box";
  write("two.toml", grain_case());
  EXPECT_EQ(load(one),
            only(one + ":8: [initial] fluid = \"two.toml\": must be a case with [fluid]"));
}

TEST_F(ConfigStart, AFileThatIsNotThere) {
  const std::string path = (folder_ / "none.toml").string();
  EXPECT_EQ(load(path), only(path + ": cannot be read: No such file or directory"));
  EXPECT_EQ(load(folder_.path().string()),
            only(folder_.path().string() + ": cannot be read: it is a folder"));
  EXPECT_EQ(load("/dev/zero"),
            only("/dev/zero: cannot be read: it is not a file but a device or a pipe"));
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("D\xC3\xBCne 1"), "D\xC3\xBCne 1");
  EXPECT_EQ(printable("a\nb\tc\rd\x1B[31m"), "a\\nb\\tc\\rd\\x1b[31m");
  EXPECT_EQ(printable("\xFF\xC3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b");  // U+009B begins a command as well
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable_lines("a\n\x1B\n"), "a\n\\x1b\n");
}

}  // namespace
}  // namespace barchan
