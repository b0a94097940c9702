// The judge of the paper's rules on friction and restitution, on runs whose dunes are made up.
#include "tests/support/dune_rules.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::DuneSeen;

/// A dune that has 20 mm, 10 mm, 4 mm and 300 grains of these at 2 s, and moves and sheds steadily.
DuneSeen base() { return {.width = 0.020, .length = 0.010, .way = 0.004, .shed = 300}; }

/// dune.csv to `end` [s], with a second dune that is none of the judge's business.
void write_run(const std::filesystem::path& run, const DuneSeen& dune, double end) {
  std::filesystem::create_directories(run);
  std::ofstream file(run / "dune.csv");
  file << "t,dune,n_grains,W,L,Cx\n";
  for (int n = 0; n <= static_cast<int>(20 * end); ++n) {
    const double t = 0.05 * n;
    file << t << ",0," << 9000 - 0.5 * t * dune.shed << ',' << (t < 1 ? 1 : dune.width) << ','
         << dune.length << ',' << 0.02 + 0.5 * t * dune.way << '\n';
    file << t << ",1,120,0.5,0.5," << 0.01 * n << '\n';
  }
}

bool all_hold(const std::vector<test::Ordering>& rules) {
  return std::ranges::all_of(rules, [](const test::Ordering& rule) { return rule.holds(); });
}

int number_that_fail(const std::vector<test::Ordering>& rules) {
  return static_cast<int>(
      std::ranges::count_if(rules, [](const test::Ordering& rule) { return !rule.holds(); }));
}

TEST(DuneRules, RunsAreComparedAtTheLastTimeThatAllHaveReached) {
  const TemporaryFolder folder;
  write_run(folder / "long", base(), 8);
  write_run(folder / "short", base(), 2);
  for (const DuneSeen& seen : test::dunes_at_the_same_time({folder / "long", folder / "short"})) {
    EXPECT_NEAR(seen.width, 0.020, 1e-12);  // a mean over the second before; 1 m in the first
    EXPECT_NEAR(seen.length, 0.010, 1e-12);
    EXPECT_NEAR(seen.way, 0.004, 1e-7);
    EXPECT_NEAR(seen.shed, 300, 1e-9);
  }
}

TEST(DuneRules, ARunWithoutADuneOrEndedTooSoonIsNotJudged) {
  const TemporaryFolder folder;
  write_run(folder / "whole", base(), 2);
  write_run(folder / "early", base(), 1);
  EXPECT_THROW(test::dunes_at_the_same_time({folder / "whole", folder / "early"}),
               std::runtime_error);
  EXPECT_THROW(test::dunes_at_the_same_time({folder / "nowhere"}), std::runtime_error);
  std::ofstream(folder / "whole" / "dune.csv") << "t,dune,n_grains,W,L,Cx\n";
  EXPECT_THROW(test::dunes_at_the_same_time({folder / "whole"}), std::runtime_error);
}

TEST(DuneRules, SlidingFriction) {
  DuneSeen low = base();
  low.width = 0.022, low.shed = 400;
  EXPECT_TRUE(all_hold(test::sliding_friction_rules(base(), low)));
  EXPECT_EQ(number_that_fail(test::sliding_friction_rules(low, base())), 2);
  low.width = 0.019;
  EXPECT_EQ(number_that_fail(test::sliding_friction_rules(base(), low)), 1);
}

TEST(DuneRules, RollingFriction) {
  DuneSeen high = base();
  high.way = 0.002;
  EXPECT_TRUE(all_hold(test::rolling_friction_rules(base(), high)));
  EXPECT_FALSE(all_hold(test::rolling_friction_rules(high, base())));
}

TEST(DuneRules, RestitutionIsJudgedByBothFrictions) {
  const DuneSeen low{.width = 0.022, .length = 0.009, .way = 0.006, .shed = 500};
  const DuneSeen high{.width = 0.018, .length = 0.012, .way = 0.002, .shed = 100};
  DuneSeen bouncy{.width = 0.0201, .length = 0.0098, .way = 0.0042, .shed = 250};
  EXPECT_TRUE(all_hold(test::restitution_rules(base(), bouncy, low, high)));
  bouncy.way = 0.0065;  // more than either changes it
  EXPECT_EQ(number_that_fail(test::restitution_rules(base(), bouncy, low, high)), 2);
  bouncy.way = 0.0042, bouncy.length = 0.0115;  // more than mu, less than mu_r
  EXPECT_EQ(number_that_fail(test::restitution_rules(base(), bouncy, low, high)), 1);
}

}  // namespace
}  // namespace barchan
