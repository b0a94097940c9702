// Hints for a mistyped key, a word of another program or the name of a missing file.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "src/case/synonyms.hpp"
#include "src/toml/keys.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::grain_case;
using test::refused;

TEST(ConfigHints, WordsOfOtherProgramsNameOurKeys) {
  const auto hinted = [](const std::string& line, const std::string& hint) {
    const std::string word = line.substr(0, line.find(' '));
    refused(grain_case(line + "\n"),
            "case.toml:10: [grains] " + word + ": unknown key (did you mean " + hint + "?)");
  };
  hinted("mu = 0.5", "\"sliding_friction\"");
  hinted("E = 5e6", "\"youngs_modulus\"");
  hinted("youngsModulus = 5e6", "\"youngs_modulus\"");
  hinted("coefficientFriction = 0.5", "\"sliding_friction\"");
  hinted("diameter = 2e-4", "\"sizes\"");
  hinted("viscosity = 1e-6", "\"kinematic_viscosity\" of [fluid]");
  hinted("dt = 1e-6", "\"grain_step\" of [time]");
  refused(fluid_case("mu = 1e-6\n"),
          "case.toml:7: [fluid] mu: unknown key (did you mean \"kinematic_viscosity\"?)");
  refused(fluid_case("Ubar = 0.2\n"),
          "case.toml:7: [fluid] Ubar: unknown key (did you mean \"mean_velocity\"?)");
  refused("deltaT = 1\n" + grain_case(),
          "case.toml:1: deltaT: unknown key (did you mean \"fluid_step\" of [time]?)");
  refused(grain_case("[output]\ninterval = 1\n"),
          "case.toml:11: [output] interval: unknown key (did you mean \"grains_interval\" or "
          "\"fields_interval\" or \"history_interval\"?)");
  refused(grain_case("[grains.ambient]\nviscosity = 1e-6\n"),
          "case.toml:11: [grains.ambient] viscosity: unknown key "
          "(did you mean \"kinematic_viscosity\"?)");
}

TEST(ConfigHints, SynonymsStandForKeysAndAreNone) {
  const auto exists = [](const std::string& dotted) {
    return std::ranges::any_of(sections(), [&](const Section& section) {
      return std::ranges::any_of(section.keys,
                                 [&](const Key& key) { return key.dotted() == dotted; });
    });
  };
  for (const Synonym& one : kSynonyms) {
    std::istringstream keys(std::string(one.keys));
    for (std::string key; keys >> key;) {
      if (key.ends_with(',')) key.pop_back();
      EXPECT_TRUE(exists(key)) << key;
    }
    std::istringstream in(std::string(one.sections));
    for (std::string section; in >> section;)
      EXPECT_FALSE(exists(section + "." + std::string(one.word))) << section << one.word;
  }
}

TEST(ConfigHints, AMissingFileNamesTheNearest) {
  const TemporaryFolder folder;
  std::ofstream(folder / "quickstart.toml") << grain_case();
  std::ofstream(folder / "quikstart.csv") << "id\n";
  const auto told = [&](const char* name) { return message_of([&] { load_case(folder / name); }); };
  const std::string hint = "(did you mean " + (folder / "quickstart.toml").string() + "?)";
  EXPECT_NE(told("quikstart.toml").find("No such file or directory " + hint), std::string::npos);
  EXPECT_EQ(told("sediment.toml").find("did you mean"), std::string::npos);
  std::ofstream(folder / "other.toml") << fluid_case("[initial]\nfluid = \"quikstart.toml\"\n");
  EXPECT_NE(told("other.toml").find(hint), std::string::npos) << told("other.toml");
}

}  // namespace
}  // namespace barchan
