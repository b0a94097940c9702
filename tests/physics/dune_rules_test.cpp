// The paper's rules on friction, restitution and rolling friction, judged from finished runs of one
// case that differ in one key each (docs/barchan-10k.md; to 2 s some 17 minutes each on one core):
//   ./barchan run configs/barchan-10k.toml --set time.end=2 --out runs/base
//   ... --set grains.sliding_friction=0.2 --out runs/mu
//   ... --set grains.restitution=0.9 --out runs/e
//   ... --set grains.rolling_friction=0.3 --out runs/mu-r
// BARCHAN_RULE_BASE, BARCHAN_RULE_MU, BARCHAN_RULE_E and BARCHAN_RULE_MU_R name the folders.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "src/config/toml_tree.hpp"
#include "tests/support/dune_rules.hpp"
#include "tests/support/finished_run.hpp"

namespace barchan {
namespace {

using test::DuneSeen;

std::filesystem::path folder_of(const std::string& run) {
  return test::finished_run("BARCHAN_RULE_" + run);
}

/// Which of the variables are not set, for a message; empty: none.
std::string unset(const std::vector<std::string>& runs) {
  std::string names;
  for (const std::string& run : runs) {
    if (folder_of(run).empty()) names.append(" BARCHAN_RULE_").append(run);
  }
  return names.empty() ? "" : "finished runs are judged, and not set:" + names;
}

Node resolved_config(const std::filesystem::path& folder) {
  std::ifstream file(folder / "config.toml");
  std::stringstream text;
  text << file.rdbuf();
  std::vector<Problem> problems;
  Node root = parse_toml(text.str(), "config.toml", problems);
  EXPECT_TRUE(file && problems.empty()) << "cannot read config.toml in " << folder;
  return root;
}

/// The keys of the physics, "grains.restitution", in which two runs differ. Keys that only one of
/// them has are younger than the other.
std::vector<std::string> differences(const Node& a, const Node& b) {
  std::vector<std::string> keys;
  for (const std::string section : {"domain", "fluid", "grains", "coupling"}) {
    const Node *in_a = a.find(section), *in_b = b.find(section);
    if (in_a == nullptr || in_b == nullptr) continue;
    for (const auto& [key, value] : *in_a->table()) {
      const Node* other = in_b->find(key);
      if (value.table() != nullptr || other == nullptr) continue;
      if (toml_text(value) != toml_text(*other)) keys.push_back(section + "." + key);
    }
  }
  return keys;
}

/// Run `name` differs from the base case in this key only.
void expect_only_difference(const std::string& name, const std::string& key) {
  const Node base = resolved_config(folder_of("BASE")), other = resolved_config(folder_of(name));
  EXPECT_EQ(differences(base, other), std::vector<std::string>{key})
      << "not the case that was meant";
}

std::vector<DuneSeen> dunes(const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> runs;
  for (const std::string& name : names) runs.push_back(folder_of(name));
  const std::vector<DuneSeen> seen = test::dunes_at_the_same_time(runs);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    const DuneSeen& d = seen[n];
    std::printf("[ measured ] %s: W %.2f mm, L %.2f mm, way %.2f mm, shed %g grains\n",
                names[n].c_str(), 1e3 * d.width, 1e3 * d.length, 1e3 * d.way, d.shed);
  }
  return seen;
}

void expect_all(const std::vector<test::Ordering>& rules) {
  for (const test::Ordering& rule : rules) {
    std::printf("[ measured ] %s: %.4g < %.4g\n", rule.claim.c_str(), rule.less, rule.more);
    EXPECT_TRUE(rule.holds()) << rule.claim << ": " << rule.less << " < " << rule.more;
  }
}

TEST(DuneRulesNightly, LowSlidingFrictionMakesADuneWiderThatShedsMore) {
  const std::vector<std::string> runs{"BASE", "MU"};
  if (const std::string why = unset(runs); !why.empty()) GTEST_SKIP() << why;
  expect_only_difference("MU", "grains.sliding_friction");
  const auto seen = dunes(runs);
  expect_all(test::sliding_friction_rules(seen[0], seen[1]));
}

TEST(DuneRulesNightly, RollingFrictionSlowsTheDune) {
  const std::vector<std::string> runs{"BASE", "MU_R"};
  if (const std::string why = unset(runs); !why.empty()) GTEST_SKIP() << why;
  expect_only_difference("MU_R", "grains.rolling_friction");
  const auto seen = dunes(runs);
  expect_all(test::rolling_friction_rules(seen[0], seen[1]));
}

TEST(DuneRulesNightly, RestitutionMattersLessThanEitherFriction) {
  const std::vector<std::string> runs{"BASE", "E", "MU", "MU_R"};
  if (const std::string why = unset(runs); !why.empty()) GTEST_SKIP() << why;
  expect_only_difference("E", "grains.restitution");
  const auto seen = dunes(runs);
  expect_all(test::restitution_rules(seen[0], seen[1], seen[2], seen[3]));
}

}  // namespace
}  // namespace barchan
