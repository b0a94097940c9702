// Promises of the table of keys for every key: it is read, written, compared and explained.
#include "src/case/resolved.hpp"
#include "src/toml/keys_page.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "src/base/errors.hpp"
#include "src/case/load.hpp"
#include "src/toml/keys.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::Lines;

/// A case with every section.
Config full_case() {
  Config c;
  for (const Section& section : sections()) {
    if (section.prepare) section.prepare(c, true);
    if (section.append) section.append(c);
  }
  return c;
}

template <class Test>
void for_each_key(const Test& test) {
  for (const Section& section : sections()) {
    for (const Key& key : section.keys) {
      SCOPED_TRACE(key.dotted());
      // These two keys are used up before a case is read.
      if (key.dotted() != "case.base" && key.dotted() != "case.without") test(key);
    }
  }
}

/// Values of all types, as TOML, with numbers that need all their digits.
const std::vector<std::string> samples{"0.1234567890123456",
                                       "3",
                                       "true",
                                       "false",
                                       "\"Quotes \\\" and \\\\ and\\na new line, \xc3\xbc\"",
                                       "\"short\"",
                                       "[0.1, 0.30000000000000004]",
                                       "[0.1, 0.30000000000000004, 0.7]",
                                       "[7, 8, 9]",
                                       "[[0.0002, 5], [0.0003333333333333333, 7]]",
                                       "[[0.1, 0.30000000000000004, 0.7, 1.5]]",
                                       "[\"drag\", \"stress\"]"};

/// Sets `key` to a value that it does not have; false if no sample fits.
bool change(const Key& key, Config& config) {
  std::vector<std::string> values = samples;
  std::stringstream choices(key.type);  // "a", "b"
  for (std::string name; std::getline(choices, name, ',');) values.push_back(name);
  for (const std::string& value : values) {
    std::vector<Problem> problems;
    const Node tree = parse_toml("value = " + value, "sample", problems);
    Config changed = config;
    if (!problems.empty() || key.read(*tree.find("value"), changed, 0)) continue;
    if (key.text(changed, 0) == key.text(config, 0)) continue;
    config = changed;
    return true;
  }
  return false;
}

TEST(ConfigKeys, EveryKeyComesBackFromTheResolvedText) {
  Config all = full_case();
  for_each_key([&](const Key& key) {
    Config one = full_case();
    if (key.dotted() == "initial.grains") one.initial.pour.reset();  // one of the two
    ASSERT_TRUE(change(key, one)) << "no sample is a " << key.type;
    EXPECT_EQ(config_as_written(to_toml(one), ""), one) << to_toml(one);
    EXPECT_NE(one, full_case());
    EXPECT_TRUE(change(key, all));
  });
  all.initial.pour.reset();
  EXPECT_EQ(config_as_written(to_toml(all), ""), all) << to_toml(all);
}

TEST(ConfigKeys, ARestartKeepsWhatItsNumbersRestOn) {
  Lines fixed;
  for_each_key([&](const Key& key) {
    const Config before = full_case();
    Config after = before;
    ASSERT_TRUE(change(key, after));
    const Lines conflicts = restart_conflicts(after, before), changed = changed_keys(after, before);
    if (key.section == "output.probe" && key.name != "interval") {  // keeps its number in the table
      ASSERT_EQ(conflicts.size(), 1u);
      return;
    }
    ASSERT_EQ(conflicts.size() + changed.size(), 1u);
    const std::string now = *key.text(after, 0), was = key.text(before, 0).value_or("absent");
    if (key.fixed_by_restart) {
      fixed.push_back(key.dotted());
      EXPECT_EQ(conflicts[0], key.dotted() + " = " + now + ": it was written with " + was);
    } else {
      EXPECT_EQ(changed[0], key.dotted() + " " + was + " -> " + now);
    }
  });
  EXPECT_EQ(fixed, (Lines{"time.fluid_step",
                          "domain.size",
                          "fluid.cells",
                          "fluid.first_cell_height",
                          "fluid.uniform_height",
                          "grains.density",
                          "grains.shape",
                          "grains.spheres",
                          "grains.clump",
                          "grains.boundary_x",
                          "grains.boundary_z",
                          "grains.floor",
                          "grains.floor_diameter",
                          "grains.kind.name",
                          "grains.kind.density",
                          "grains.kind.shape",
                          "grains.kind.spheres",
                          "grains.kind.clump",
                          "body.name",
                          "body.shape",
                          "body.centre",
                          "body.base",
                          "body.axis",
                          "body.radius",
                          "body.height",
                          "body.length",
                          "body.size",
                          "body.lee",
                          "body.spacing",
                          "body.wavelength",
                          "body.angle"}));
  EXPECT_EQ(restart_conflicts(Config{}, full_case()),
            (Lines{"[fluid]: it was written by a case with this section",
                   "[grains]: it was written by a case with this section"}));
  Config without = full_case();
  without.statistics.reset();
  EXPECT_EQ(changed_keys(without, full_case()).front(), "statistics.start 0.0 -> absent");
}

TEST(ConfigKeys, RangesRefuseWhatTheySay) {
  for_each_key([](const Key& key) {
    if (key.range.text().empty() || key.type == "text" || key.name == "sizes") return;
    const auto refused = [&](double number) {
      Node node;
      node.value = number;
      if (key.type.find("integer") != key.type.npos) node.value = std::int64_t(number);
      if (key.type.starts_with("array of 2")) node.value = NodeArray{node, node};
      if (key.type.starts_with("array of 3")) node.value = NodeArray{node, node, node};
      Config config = full_case();
      return key.read(node, config, 0);
    };
    const auto [min, max, above_min, below_max] = key.range;
    EXPECT_EQ(refused(min).has_value(), above_min);
    EXPECT_EQ(refused(min - std::abs(min) - 1), key.range.text());
    if (max == Range::infinite) return;
    EXPECT_EQ(refused(max).has_value(), below_max);
    EXPECT_EQ(refused(2 * max), key.range.text());
  });
}

TEST(ConfigKeys, ThePageOfKeysIsThatOfTheProgram) {
  std::ifstream file(BARCHAN_SOURCE_DIR "/docs/keys.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_TRUE(page.str() == keys_page()) << "renew it: ./barchan keys > docs/keys.md";
  for_each_key([](const Key& key) {
    EXPECT_FALSE(key.meaning.empty());
    EXPECT_NE(keys_page().find("| `" + key.name + "` | " + key.type), std::string::npos);
  });
}

TEST(ConfigKeys, ASectionFitsTheTerminal) {
  const std::string grains = keys_text("grains");
  for (const char* part : {"[grains]\nThe grains", "\n  tangential_damping  factor on the dashpots",
                           "default 0.6", "[kg/m3]"})
    EXPECT_NE(grains.find(part), std::string::npos) << grains;
  EXPECT_EQ(grains.find("drop_height"), std::string::npos);
  for (const Section& section : sections()) {
    if (section.keys.empty()) continue;
    std::istringstream text(keys_text(section.name));
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 100U) << line;
    for (const Key& key : section.keys) {
      EXPECT_NE(text.str().find("\n  " + key.name + " "), std::string::npos) << key.name;
      EXPECT_NE(keys_text(key.dotted()).find("\n  " + key.name + " "), std::string::npos);
    }
  }
  EXPECT_EQ(keys_text("pour"), keys_text("initial.grains.pour"));
  EXPECT_EQ(keys_text("sliding_friction").find(keys_text("grains.sliding_friction")), 0U);
  EXPECT_NE(keys_text("sliding_friction").find("[grains.wall]"), std::string::npos);
  EXPECT_THROW(keys_text("grans"), InputError);
  EXPECT_NE(message_of([] { keys_text("grans"); }).find("did you mean \"grains\"?"),
            std::string::npos);
  EXPECT_NE(message_of([] { keys_text("grains.skim"); }).find("\"grains.skin\"?"),
            std::string::npos);
}

TEST(ConfigKeys, RemovedKeysAreToldAndOldRestartsStillRead) {
  test::refused(test::fluid_case("[solver]\ncorrectors = 2\n"),
                "case.toml:8: [solver] correctors: was removed after version 0.1.0: one correction "
                "of the pressure a step is exact; delete this line");
  test::refused(test::fluid_case("[solver]\npreconditioner = \"jacobi\"\n"),
                "case.toml:8: [solver] preconditioner = \"jacobi\": was removed after version "
                "0.1.0: take \"local_fft\", the default, or \"fft\"");
  const Config now = load_config_text(test::fluid_case(), "case.toml");
  const std::string old = to_toml(now) + "correctors = 1\n";
  EXPECT_EQ(config_as_written(old, "case.toml"), now);
}

TEST(ConfigResolved, ACaseIsTheSameInOtherWords) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& text, const Config& config) {
    std::ofstream(folder / "config.toml") << text;
    return is_written_in(folder / "config.toml", config);
  };
  const Config c = load_config_text(test::grain_case(), "case.toml",
                                    {"time.fluid_step=2.5e-4", "time.grain_step=2.5e-6"});
  EXPECT_FALSE(is_written_in(folder / "config.toml", c));
  EXPECT_TRUE(says(to_toml(c), c));
  EXPECT_TRUE(says("# a comment\n" + test::grain_case("density = 2500\n"), c));
  EXPECT_FALSE(says(test::grain_case("density = 2501\n"), c));
  EXPECT_FALSE(says(test::grain_case("density = \"2500\"\n"), c));
  EXPECT_FALSE(says("not TOML", c));
}

}  // namespace
}  // namespace barchan
