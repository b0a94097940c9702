// Grains of several kinds from the case to the state and its files.
#include "src/grains/kinds.hpp"
#include "kernels/grains/sphere.hpp"
#include "src/case/heaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "src/case/derived.hpp"
#include "src/case/resolved.hpp"
#include "src/case/validate.hpp"
#include "src/grains/grain_kinds.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/grain_table.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"
#include "src/parallel/mirror.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

const std::string kTwo =
    "density = 2650\nrestitution = 0.3\n[[grains.kind]]\nname = \"glass\"\n"
    "[[grains.kind]]\nname = \"zirconium\"\ndensity = 4100\nyoungs_modulus = 1.5e7\n"
    "sizes = [[0.3e-3, 50], [0.2e-3, 10]]\n";

Config two_kinds(const std::string& more = "") {
  return load_config_text(grain_case(kTwo + more), "case.toml");
}

TEST(Kinds, WhatIsNotGivenIsThatOfGrains) {
  const GrainConfig grains = *two_kinds().grains;
  ASSERT_EQ(grains.kinds.size(), 2u);
  const KindConfig &glass = grains.kinds[0], &zirconium = grains.kinds[1];
  EXPECT_EQ(glass.density, 2650);
  EXPECT_EQ(glass.material, grains.material);
  EXPECT_EQ(glass.sizes, (std::vector<SizeClass>{{2e-4, 100}}));
  EXPECT_EQ(zirconium.density, 4100);
  EXPECT_EQ(zirconium.material.youngs_modulus, 1.5e7);
  EXPECT_EQ(zirconium.material.restitution, 0.3);
  EXPECT_EQ(poured_sizes(grains),
            (std::vector<SizeClass>{{2e-4, 100, 0}, {3e-4, 50, 1}, {2e-4, 10, 1}}));
}

TEST(Kinds, TheyAreWrittenAsTheyAreRead) {
  const Config config =
      two_kinds("[[grains.pair]]\nkinds = [\"glass\", \"zirconium\"]\nsliding_friction = 0.9\n");
  const Config again = config_as_written(to_toml(config), "case.toml");
  EXPECT_EQ(again.grains->kinds, config.grains->kinds);
  EXPECT_EQ(again.grains->pairs, config.grains->pairs);
  EXPECT_EQ(again.grains->pairs[0].sliding_friction, 0.9);
  EXPECT_FALSE(again.grains->pairs[0].restitution);
}

TEST(Kinds, ARestartKeepsTheirNamesAndDensities) {
  const Config config = two_kinds();
  Config other = config;
  other.grains->kinds[1].material.restitution = 0.9;
  EXPECT_TRUE(restart_conflicts(other, config).empty());
  EXPECT_EQ(changed_keys(other, config), Lines{"grains.kind.restitution 0.3, 0.3 -> 0.3, 0.9"});
  other.grains->kinds[0].density = 2000;
  EXPECT_EQ(restart_conflicts(other, config),
            Lines{"grains.kind.density = 2000.0, 4100.0: it was written with 2650.0, 4100.0"});
}

TEST(Kinds, MistakesAreToldWhereTheyAre) {
  const auto tells = [](const std::string& lines, const std::string& line) {
    SCOPED_TRACE(lines);
    refused(grain_case(lines), line);
  };
  const std::string glass = "[[grains.kind]]\nname = \"glass\"\n",
                    sand = "[[grains.kind]]\nname = \"sand\"\n";
  tells("[[grains.kind]]\ndensity = 2000\n",
        "case.toml:10: [grains.kind] name: required key is missing");
  tells(glass + "[[grains.kind]]\nname = \"a b\"\n",
        "case.toml:13: [grains.kind.2] name = \"a b\": must be a word of letters, digits, \".\", "
        "\"-\" and \"_\"; \"a b\" is not");
  tells(glass + glass,
        "case.toml:13: [grains.kind.2] name = \"glass\": must be another one for each kind; two "
        "are \"glass\"");
  tells(glass + "densty = 2000\n",
        "case.toml:12: [grains.kind] densty: unknown key (did you mean \"density\"?)");
  tells(glass + "[[grains.pair]]\nkinds = [\"glass\", \"glas\"]\nrestitution = 0.5\n",
        "case.toml:13: [grains.pair.1] kinds = [\"glass\", \"glas\"]: must be names of "
        "[[grains.kind]]; \"glas\" is none (did you mean \"glass\"?)");
  tells(glass + sand + "[[grains.pair]]\nkinds = [\"sand\", \"glass\"]\nrestitution = 0.0\n",
        "case.toml:16: [grains.pair] restitution = 0.0: must be above 0 and at most 1");
  tells(glass + sand + "[[grains.pair]]\nkinds = [\"sand\", \"sand\"]\nrestitution = 0.5\n",
        "case.toml:15: [grains.pair.1] kinds = [\"sand\", \"sand\"]: must be two kinds; contacts "
        "of \"sand\" with itself are those of its [[grains.kind]]");
  tells(
      glass + sand + "[[grains.pair]]\nkinds = [\"sand\", \"glass\", \"sand\"]\n",
      "case.toml:15: [grains.pair] kinds = [\"sand\", \"glass\", \"sand\"]: must be an array of 2 "
      "strings");
  tells("[[grains.pair]]\nkinds = [\"sand\", \"glass\"]\nrestitution = 0.5\n",
        "case.toml:10: [grains] pair = [{ kinds = [\"sand\", \"glass\"], restitution = 0.5 }]: "
        "must be "
        "absent without [[grains.kind]]");
  tells("density = 2000\n" + glass + "density = 3000\n",
        "case.toml:10: [grains] density = 2000: must be absent: every [[grains.kind]] has its own");
  tells(glass + "sizes = [[3e-4, 5]]\n",
        "case.toml:9: [grains] sizes = [[0.0002, 100]]: must be absent: every [[grains.kind]] has "
        "its own");
}

TEST(Kinds, MoreThanTheTablesHoldAreRefused) {
  std::string five;
  for (const char* name : {"a", "b", "c", "d", "e"})
    five += std::string("[[grains.kind]]\nname = \"") + name + "\"\n";
  const Lines lines = problems(grain_case(five));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("must be at most 4 sections"), std::string::npos) << lines[0];
}

// Glass, 2650: pi r sqrt(rho/G)/(0.1631 s + 0.8766). Zirconium is stiffer by 3, denser by 1.547:
// its time for equal size is shorter by sqrt(1.547/3).
TEST(Kinds, NumbersAreThoseOfEachKind) {
  Config config = two_kinds("[grains.ambient]\n");
  const Derived derived = derive(config, poured_sizes(*config.grains));
  const GrainNumbers& n = *derived.grains;
  ASSERT_EQ(n.kinds.size(), 2u);
  EXPECT_EQ(n.kinds[0].name, "glass");
  EXPECT_EQ(n.fastest_contacts.name, "zirconium");
  EXPECT_NEAR(n.kinds[1].rayleigh_min / n.kinds[0].rayleigh_min,
              std::sqrt(4100.0 / 2650 * 5e6 / 1.5e7), 1e-12);
  EXPECT_EQ(n.kinds[1].fall_velocity,
            settling_velocity(mean_diameter({{3e-4, 50}, {2e-4, 10}}), 4.1, 1e-6, 9.81));
  EXPECT_NE(to_text(derived).find("zirconium: 4100 kg/m3"), std::string::npos);
}

TEST(Kinds, EachFloatsByItsOwnDensity) {
  const std::string text = grain_case(
      "[[grains.kind]]\nname = \"glass\"\n[[grains.kind]]\nname = \"wax\"\n"
      "density = 900\nyoungs_modulus = 1e6\n[grains.ambient]\n");
  const Case the_case = load_case_text(text, "case.toml");
  const Lines lines = config_warnings(the_case.config, the_case.sizes);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("those of \"wax\" float"), std::string::npos) << lines[0];
}

std::filesystem::path written(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

TEST(Kinds, SizesThatDifferMuchWantKindsOfTheirOwn) {
  const std::string text = grain_case("[[grains.kind]]\nname = \"a\"\n");
  const auto warned = [&](const std::string& sizes, const std::string& more) {
    const Case the_case = load_case_text(text + more, "case.toml", {"grains.sizes=" + sizes});
    const Lines lines = config_warnings(the_case.config, the_case.sizes);
    return !lines.empty() && lines[0].find("diameters of 1 to") != std::string::npos;
  };
  EXPECT_TRUE(warned("[[2e-4, 50], [7e-4, 5]]", ""));
  EXPECT_FALSE(warned("[[2e-4, 50], [6e-4, 5]]", ""));
  EXPECT_FALSE(warned("[[2e-4, 50], [7e-4, 5]]", "[[grains.kind]]\nname = \"b\"\n"));
}

InitialGrains poured(const std::vector<SizeClass>& sizes) {
  const HeapConfig cone{.centre = {0.05, 0.02}, .radius = 4e-3, .sizes = sizes};
  return pour_grains({cone}, {0.1, 0.025, 0.04});
}

// Places are those of one kind; which grain is of which is random: 1000 of 2000 in either half,
// to five standard deviations.
TEST(Kinds, ArePouredMixed) {
  const InitialGrains one = poured({{2e-4, 2000}});
  const InitialGrains two = poured({{2e-4, 1000, 0}, {2e-4, 1000, 1}});
  EXPECT_TRUE(one.kind.empty());
  ASSERT_EQ(two.kind.size(), 2000u);
  int of_second = 0, low = 0;
  for (std::size_t g = 0; g < 2000; ++g) {
    EXPECT_EQ(norm(one.x[g] - two.x[g]), 0);
    of_second += two.kind_of(g);
    low += g < 1000 ? two.kind_of(g) : 0;  // ids count from the axis outwards and upwards
  }
  EXPECT_EQ(of_second, 1000);
  EXPECT_NEAR(low, 500, 5 * std::sqrt(2000.0) / 4);
}

// A heap of one kind has its sizes; one without a kind has those of both.
TEST(Kinds, AHeapMayBeOfOneKind) {
  Config config = two_kinds();
  config.initial.pour.reset();
  config.initial.heaps.resize(2);
  config.initial.heaps[0].kind = config.grains->kinds[1].name;
  const std::vector<HeapConfig> heaps = poured_heaps(config);
  ASSERT_EQ(heaps.size(), 2u);
  for (const SizeClass& size : heaps[0].sizes) EXPECT_EQ(size.kind, 1);
  EXPECT_EQ(heaps[0].sizes.size(), config.grains->kinds[1].sizes.size());
  EXPECT_EQ(heaps[1].sizes, poured_sizes(*config.grains));
}

TEST(Kinds, AMassIsThatOfItsDensity) {
  const Config config = two_kinds();
  const SystemState state = make_initial_state(config, {});
  const auto kin = host_copy(state.grains->kin);
  const auto kind = host_copy(state.grains->kind);
  int n_second = 0;
  for (int g = 0; g < state.grains->n; ++g) {
    const Real density = kind(g) == 1 ? 4100 : 2650;
    EXPECT_DOUBLE_EQ(kin(g).m, density * sphere_volume(kin(g).r));
    EXPECT_TRUE(kind(g) == 1 || kin(g).r == 1e-4);
    n_second += kind(g);
  }
  EXPECT_EQ(n_second, 60);
}

TEST(Kinds, MixingIsTheGeometricMean) {
  GrainConfig config;
  config.kinds = {{.name = "a", .material = {5e6, 0.3, 0.9, 0.2, 0.0}, .sizes = {}},
                  {.name = "b", .material = {4e7, 0.2, 0.4, 0.8, 0.1}, .sizes = {}},
                  {.name = "c", .material = {5e6, 0.3, 0.9, 0.2, 0.0}, .sizes = {}}};
  config.pairs = {{.kinds = {"c", "b"}, .sliding_friction = 0.7}};
  const GrainKinds kinds = kinds_of(config);
  EXPECT_DOUBLE_EQ(kinds.contact(1, 0).restitution, 0.6);
  EXPECT_DOUBLE_EQ(kinds.contact(0, 1).sliding_friction, 0.4);
  EXPECT_EQ(kinds.contact(0, 1).rolling_friction, 0);
  EXPECT_EQ(kinds.contact(0, 2).restitution, 0.9);  // of equal ones the same bits
  EXPECT_EQ(kinds.contact(1, 2).sliding_friction, 0.7);
  EXPECT_DOUBLE_EQ(kinds.contact(2, 1).restitution, 0.6);
  EXPECT_EQ(kinds.contact(1, 1).sliding_friction, 0.8);
}

// --- Files.

const char kTable[] =
    "id,kind,diameter,x,y,z\n"
    "1,zirconium,0.0002,0.01,0.001,0.01\n2,glass,0.0002,0.02,0.001,0.01\n"
    "3,zirconium,0.0002,0.03,0.001,0.01\n";

TEST(Kinds, ATableHasNames) {
  const InitialGrains grains = parse_grains_csv(kTable, "heap.csv");
  EXPECT_EQ(grains.kind_names, (std::vector<std::string>{"zirconium", "glass"}));
  EXPECT_EQ(grains.kind, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_TRUE(parse_grains_csv("id,diameter,x,y,z\n1,1,1,1,1\n", "heap.csv").kind.empty());
  EXPECT_EQ(
      message_of([] { parse_grains_csv("id,kind,diameter,x,y,z\n1,,1,1,1,1\n", "heap.csv"); }),
      "heap.csv:2: kind is empty: it must be a name of [[grains.kind]]");
}

TEST(Kinds, ThoseOfAFileBecomeThoseOfTheCase) {
  const TemporaryFolder folder;
  const auto file = written(folder / "heap.csv", kTable);
  Config config = two_kinds();
  config.initial.pour.reset();
  EXPECT_EQ(checked_grains(config, file).kind, (std::vector<std::uint8_t>{1, 0, 1}));
  config.grains->kinds[1].name = "zircon";
  EXPECT_EQ(message_of([&] { checked_grains(config, file); }),
            file.string() +
                ": it must hold kinds of [[grains.kind]] alone; \"zirconium\" is none (did you "
                "mean \"zircon\"?)");
  config.grains->kinds.clear();
  EXPECT_EQ(message_of([&] { checked_grains(config, file); }),
            file.string() +
                ": it must hold grains of one kind; there is no [[grains.kind]] \"zirconium\"");
  const auto plain = written(folder / "plain.csv", "id,diameter,x,y,z\n1,0.0002,0.01,0.001,0.01\n");
  config = two_kinds();
  config.initial.pour.reset();
  EXPECT_EQ(
      message_of([&] { checked_grains(config, plain); }),
      plain.string() + ": it must say of which kind each grain is, \"glass\" or \"zirconium\"");
}

TEST(Kinds, WhereThereIsOneAFileNeedNotNameIt) {
  const TemporaryFolder folder;
  const auto plain = written(folder / "plain.csv", "id,diameter,x,y,z\n1,0.0002,0.01,0.001,0.01\n");
  Config config = load_config_text(grain_case("[[grains.kind]]\nname = \"sand\"\ndensity = 2650\n"),
                                   "case.toml");
  config.initial.pour.reset();
  EXPECT_EQ(checked_grains(config, plain).size(), 1u);
  const SystemState state = make_initial_state(config, {.fluid = {}, .grains = plain});
  EXPECT_DOUBLE_EQ(host_copy(state.grains->kin)(0).m, 2650 * sphere_volume(1e-4));
}

TEST(Kinds, AFrameHasThemWithTheirNames) {
  const TemporaryFolder folder;
  const Config config = two_kinds();
  SystemState state = make_initial_state(config, {});
  state.grains->kind_names = names_of_kinds(*config.grains);
  OutputFiles(folder.path(), {}).write_grains(*state.grains, 0, 0);
  const InitialGrains grains = read_grains(folder / "grains.h5");
  EXPECT_EQ(grains.kind_names, (std::vector<std::string>{"glass", "zirconium"}));
  const auto kind = host_copy(state.grains->kind);
  const auto id = host_copy(state.grains->id);
  ASSERT_EQ(grains.kind.size(), static_cast<std::size_t>(state.grains->n));
  for (int g = 0; g < state.grains->n; ++g) {
    EXPECT_EQ(grains.id[static_cast<std::size_t>(g)], id(g));
    EXPECT_EQ(grains.kind_of(static_cast<std::size_t>(g)), kind(g));
  }
}

TEST(Kinds, ACaseThatStartsFromAnotherHasItsKinds) {
  const TemporaryFolder folder;
  written(folder / "heap.toml", grain_case(kTwo));
  const auto starts = [&](const std::string& grains) {
    return lines_of([&] {
      const Case the_case = load_case_text(
          "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[initial]\ngrains = "
          "\"heap.toml\"\n[grains]\n" +
              grains,
          folder / "case.toml");
      // Zirconium is the first kind in this case.
      EXPECT_EQ(the_case.sizes,
                (std::vector<SizeClass>{{2e-4, 100, 1}, {3e-4, 50, 0}, {2e-4, 10, 0}}));
    });
  };
  const std::string zirconium = "[[grains.kind]]\nname = \"zirconium\"\n";
  EXPECT_EQ(starts(zirconium + "[[grains.kind]]\nname = \"glass\"\n"), Lines{});
  const Lines lines = starts("");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("must hold grains of one kind"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace barchan
