// Parts that a case need not write out: lengths in other units, steps that are chosen, keys of
// another case.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/case/resolved.hpp"
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

// 30 of 0.2 mm and 10 of 0.4 mm: 0.25 mm in the mean.
const std::string two_sizes = coupled_case("[[0.2e-3, 30], [\"0.4 mm\", 10]]");

Config with(const Lines& overrides) { return load_config_text(two_sizes, "case.toml", overrides); }

TEST(Lengths, MayBeInMeanDiameters) {
  const Config c = with({"coupling.smoothing_length=3 d", "grains.skin=\"0.2d\""});
  EXPECT_EQ(c.coupling.smoothing_length, 7.5e-4);
  EXPECT_EQ(c.grains->skin, 5e-5);
  // Lengths are in metres when written, and when read again for a restart.
  EXPECT_EQ(to_toml(c).find(" d\""), std::string::npos);
  EXPECT_EQ(config_as_written(to_toml(c), c.file), c);
  EXPECT_EQ(with({"coupling.smoothing_length=0 d"}).coupling.smoothing_length, 0);
  const Config thin =
      with({"fluid.first_cell_height=0.8 d", "fluid.uniform_height=2 d", "fluid.cells=[62,34,25]"});
  EXPECT_EQ(thin.fluid->first_cell_height, 2e-4);
  EXPECT_EQ(thin.fluid->uniform_height, 5e-4);
}

TEST(Lengths, MayBeInAnyUnitWhereverOneStands) {
  const Config c = with({"domain.size=[\"10 cm\", \"0.025 m\", 0.04]",
                         "initial.grains.pour.centre=[\"20mm\", \"80 d\"]",
                         "initial.grains.pour.radius=6000 um"});
  EXPECT_EQ(c.size, (std::array<double, 3>{0.1, 0.025, 0.04}));
  EXPECT_EQ(c.initial.pour->centre, (std::array<double, 2>{0.02, 0.02}));
  EXPECT_EQ(c.initial.pour->radius, 6e-3);
  EXPECT_EQ(c.grains->sizes, (std::vector<SizeClass>{{2e-4, 30}, {4e-4, 10}}));
}

TEST(Lengths, MustBeLengths) {
  for (const std::string wrong : {"3 dd", "d", "3 miles", "inf d", "3 mm 2"}) {
    EXPECT_EQ(problems(two_sizes, {"grains.skin=\"" + wrong + "\""}),
              only("--set grains.skin = \"" + wrong +
                   "\": must be a number of metres, or a length as \"0.2 mm\" or, in mean grain "
                   "diameters, \"3 d\""));
  }
  refused(two_sizes, "--set grains.skin = \"-1 d\": must be at least 0 and at most 1000",
          {"grains.skin=-1 d"});
  refused(two_sizes,
          "--set domain.size = [\"1e10 d\", 1, 1]: must be at least 1e-09 and at most "
          "1e+06",
          {"domain.size=[\"1e10 d\", 1, 1]"});
  // Diameters are what d rests on; and a density is no length.
  EXPECT_FALSE(problems(two_sizes, {"grains.sizes=[[\"1 d\", 3]]"}).empty());
  EXPECT_FALSE(problems(two_sizes, {"grains.density=\"3 mm\""}).empty());
}

TEST(Lengths, HaveDefaultsInDiameters) {
  const Config c = with({});
  EXPECT_EQ(c.coupling.smoothing_length, 7.5e-4);
  EXPECT_EQ(c.grains->skin, 5e-5);
  // A few grains more or less, or other classes of the same mean, change no mesh.
  EXPECT_EQ(load_config_text(coupled_case("[[1.7e-4, 250], [2.3e-4, 249]]"), "case.toml")
                .coupling.smoothing_length,
            6e-4);
}

TEST(Pour, HasAPlaceInItsBox) {
  const std::string text =
      "[time]\nend = 1\n[domain]\nsize = [0.05, 0.02, 0.03]\n[grains]\n"
      "sizes = [[2e-4, 50]]\n[initial]\ngrains = { pour = { radius = 3e-3 } }\n";
  const Config c = load_config_text(text, "case.toml");
  EXPECT_EQ(c.initial.pour->centre, (std::array{0.01, 0.015}));
  EXPECT_EQ(problems(text, {"initial.grains={ pour = { shape = \"bed\" } }"}), Lines{});
}

TEST(Steps, FollowTheRules) {
  const Config c = with({"time.fluid_step=auto", "fluid.mean_velocity=0.28"});
  const Derived numbers = derive(c, c.grains->sizes);
  EXPECT_GT(numbers.fluid->cfl, 0.09);  // 0.13, rounded down to what fits into 0.01 s
  EXPECT_LE(numbers.fluid->cfl, 0.13);
  const double in_interval = 0.01 / c.time.fluid_step;
  EXPECT_NEAR(in_interval, std::round(in_interval), 1e-9);
  EXPECT_GT(numbers.grains->fraction_min, 0.18);
  EXPECT_LE(numbers.grains->fraction_min, 0.2 * (1 + 1e-9));
  // Steps are written as numbers: a run that goes on, or that others repeat, has the same.
  EXPECT_NE(to_toml(c).find(fmt::format("fluid_step = {}\n", c.time.fluid_step)),
            std::string::npos);
  EXPECT_EQ(load_config_text(to_toml(c), c.file), c);
  // Twice the velocity, half the step or less.
  EXPECT_LE(with({"time.fluid_step=auto", "fluid.mean_velocity=0.56"}).time.fluid_step,
            0.5 * c.time.fluid_step);
  refused(two_sizes, "--set time.end = \"auto\": must be a number", {"time.end=auto"});
}

/// Grain steps at which packings were measured to be stable, and the exact limits
/// (docs/theory-grains.md): the chosen one may not be above them.
TEST(Steps, OfSoftGrainsAreStable) {
  struct Measured {
    double youngs_modulus, limit;
  };
  for (const auto& [modulus, limit] : {Measured{2e4, 24.6e-6}, {3.125e5, 8.0e-6}, {5e6, 3.2e-6}}) {
    const Config c = load_config_text(
        grain_case(), "case.toml",
        {"grains.sizes=[[1.5e-4, 10], [2e-4, 80], [2.5e-4, 10]]",
         fmt::format("grains.youngs_modulus={}", modulus), "time.grain_step=auto"});
    EXPECT_LE(c.time.grain_step, limit) << modulus;
    EXPECT_GE(c.time.grain_step, 0.5 * limit) << modulus;
  }
}

class Bases : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  static Lines load(const std::string& path, const Lines& overrides = {}) {
    return test::lines_of([&] { load_config(path, overrides); });
  }
  const TemporaryFolder folder_;
};

TEST_F(Bases, GiveWhatTheCaseDoesNotSay) {
  write("base.toml", "[case]\ntitle = \"The base\"\n" + grain_case("restitution = 0.4\n"));
  const std::string path = write(
      "case.toml", "[case]\nbase = \"base.toml\"\n[grains]\nrestitution = 0.3\ndensity = 2000\n");
  const Config base = load_config((folder_ / "base.toml").string()), c = load_config(path);
  EXPECT_EQ(c.grains->material.restitution, 0.3);
  EXPECT_EQ(c.grains->density, 2000);
  EXPECT_EQ(c.grains->sizes, base.grains->sizes);
  EXPECT_EQ(c.initial.pour, base.initial.pour);
  EXPECT_EQ(c.title, "") << "a title is of its own case";
  EXPECT_EQ(load_config(path, {"grains.restitution=0.2"}).grains->material.restitution, 0.2);
}

TEST_F(Bases, MayBeSeveralAndHaveBases) {
  write("flow.toml", fluid_case("mean_velocity = 0.2\n[case]\ntitle = \"a\"\n"));
  write("deep/root.toml", grain_case("restitution = 0.4\nsliding_friction = 0.1\n"));
  write("deep/heap.toml", "[case]\nbase = \"root.toml\"\n[grains]\nsliding_friction = 0.2\n");
  const std::string path =
      write("case.toml", "[case]\nbase = [\"flow.toml\", \"deep/heap.toml\"]\n");
  const Config c = load_config(path);
  ASSERT_TRUE(c.fluid && c.grains);
  EXPECT_EQ(c.grains->material.restitution, 0.4);
  EXPECT_EQ(c.grains->material.sliding_friction, 0.2);
}

TEST_F(Bases, NameFilesFromTheirOwnFolder) {
  write("deep/grains.csv", "id,diameter,x,y,z\n1,2e-4,0.01,0.001,0.01\n");
  write("deep/base.toml",
        "[time]\nend = 1\n[domain]\nsize = [0.1, 0.025, 0.04]\n[grains]\n[initial]\n"
        "grains = \"grains.csv\"\n");
  const std::string path = write("case.toml", "[case]\nbase = \"deep/base.toml\"\n");
  EXPECT_EQ(load_config(path).initial.grains, (folder_ / "deep/grains.csv").string());
}

TEST_F(Bases, LoseWhatIsLeftOutAndWhatHasNoEffect) {
  write("base.toml", grain_case("[grains.feed]\nrate = 10\n[grains.ambient]\n"));
  const std::string kept = write("kept.toml", "[case]\nbase = \"base.toml\"\n");
  EXPECT_TRUE(load_config(kept).grains->feed);
  const std::string path =
      write("case.toml",
            "[case]\nbase = \"base.toml\"\nwithout = [\"grains.feed\", \"grains.sizes\"]\n"
            "[grains]\nsizes = [[3e-4, 5]]\n");
  const Config c = load_config(path);
  EXPECT_FALSE(c.grains->feed);
  EXPECT_EQ(c.grains->sizes, (std::vector<SizeClass>{{3e-4, 5}}));
  // A length in d, too, where the base has no flow any more.
  write("coupled.toml", coupled_case() + "[coupling]\nsmoothing_length = \"2 d\"\n");
  EXPECT_EQ(load(write("grains.toml",
                       "[case]\nbase = \"coupled.toml\"\nwithout = [\"fluid\", "
                       "\"initial.fluid\"]\n")),
            Lines{});
  // The elastic constants of the base mean nothing to linear springs; those of the case are told.
  write("hard.toml", grain_case("youngs_modulus = 1e6\n"));
  const std::string linear =
      "[case]\nbase = \"hard.toml\"\n[grains]\ncontact_model = \"linear\"\n"
      "linear_stiffness = 100\n";
  EXPECT_TRUE(load(write("linear.toml", linear)).empty());
  EXPECT_EQ(load(write("both.toml", linear + "poisson_ratio = 0.3\n")).size(), 2u);
}

TEST_F(Bases, MustBeCases) {
  const auto told = [&](const std::string& lines, const std::string& why) {
    const std::string path = write("case.toml", "[case]\n" + lines + "\n" + grain_case());
    const auto line = std::count(lines.begin(), lines.end(), '\n') + 2;
    EXPECT_EQ(load(path), only(fmt::format("{}:{}: [case] {}", path, line, why)));
  };
  write("base.toml", grain_case());
  write("study.toml", "[study]\nbase = \"base.toml\"\n");
  told("base = 3", "base = 3: must be a case file, or a list of them");
  told("base = \"heap.csv\"", "base = \"heap.csv\": must be a file ending in .toml");
  told("base = \"basse.toml\"", "base = \"basse.toml\": must be a file that exists; there is no " +
                                    (folder_ / "basse.toml").string() + " (did you mean " +
                                    (folder_ / "base.toml").string() + "?)");
  told("base = \"case.toml\"", "base = \"case.toml\": must not lead back to this case");
  told("base = \"study.toml\"", "base = \"study.toml\": must be a case; this is a study");
  told("without = \"fluid\"", "without = \"fluid\": must come with a base");
  told("base = \"base.toml\"\nwithout = \"fluid\"",
       "without = \"fluid\": must be a section or a key that the base has");
}

TEST_F(Bases, MistakesInThemAreToldWhereTheyStand) {
  const std::string base = write("base.toml", grain_case("restitution = 3\n"));
  const std::string path = write("case.toml", "[case]\nbase = \"base.toml\"\n");
  EXPECT_EQ(load(path),
            only(base + ":10: [grains] restitution = 3: must be above 0 and at most 1"));
  EXPECT_EQ(load(path, {"grains.restitution=0.1", "case.base=other.toml"}),
            only("--set case.base = \"other.toml\": must stand in the file of the case; --set "
                 "changes single keys of it"));
  write("base.toml", "[time\n");
  EXPECT_EQ(load(path).size(), 2u);
}

}  // namespace
}  // namespace barchan
