// Keys of earlier versions: what they mean today, and what is said of them.
#include <gtest/gtest.h>

#include "src/case/resolved.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/coupling_schemes.hpp"

namespace barchan {
namespace {

using test::coupled_case;
using test::Lines;

Case case_with(const std::string& coupling, const Lines& overrides = {}) {
  return load_case_text(coupled_case() + "[coupling]\n" + coupling, "case.toml", overrides);
}

CouplingConfig chosen(const std::string& coupling, const Lines& overrides = {}) {
  return case_with(coupling, overrides).config.coupling;
}

/// The coupling of a case without old keys that takes one of the schemes.
CouplingConfig coupling_of(const test::Scheme& scheme) {
  CouplingConfig coupling = chosen("");
  scheme.choose(coupling);
  return coupling;
}

struct OldPair {
  std::string exchange, void_fraction;
  const test::Scheme& today;
};

// Scheme that earlier versions computed with for each pair: by_row needs the points of "divided".
const OldPair kPairs[] = {{"by_row", "divided", test::kSchemes[0]},
                          {"by_row", "centre", test::kSchemes[2]},
                          {"by_row", "cfdem_faithful", test::kSchemes[5]},
                          {"interpolated", "divided", test::kSchemes[1]},
                          {"interpolated", "centre", test::kSchemes[2]},
                          {"interpolated", "cfdem_faithful", test::kSchemes[5]},
                          {"smoothed", "divided", test::kSchemes[3]},
                          {"smoothed", "centre", test::kSchemes[4]},
                          {"smoothed", "cfdem_faithful", test::kSchemes[6]}};

std::string in_file(const OldPair& old) {
  return "exchange = \"" + old.exchange + "\"\nvoid_fraction = \"" + old.void_fraction + "\"\n";
}

TEST(OldKeys, OfTheExchangeNameTheSameScheme) {
  for (const OldPair& old : kPairs) {
    SCOPED_TRACE(in_file(old));
    const CouplingConfig today = coupling_of(old.today);
    EXPECT_EQ(chosen(in_file(old)), today);
    EXPECT_EQ(chosen("", {"coupling.exchange=" + old.exchange,
                          "coupling.void_fraction=" + old.void_fraction}),
              today);
  }
  EXPECT_EQ(chosen("void_fraction = \"centre\"\n"), coupling_of(test::kSchemes[2]));
}

TEST(OldKeys, StandInConfigurationsOfEarlierRuns) {
  for (const OldPair& old : kPairs) {
    Config today = case_with("").config;
    std::string text = to_toml(today);
    old.today.choose(today.coupling);
    const std::string scheme = "scheme = \"layered\"\n";
    const std::size_t at = text.find(scheme), sections = text.find("[coupling.centred]");
    ASSERT_NE(at, text.npos);
    text.erase(sections, text.find("[initial]") - sections);
    text.replace(at, scheme.size(), in_file(old));
    EXPECT_EQ(config_as_written(text, today.file), today) << text;
    EXPECT_TRUE(says(text, today));
  }
}

TEST(OldKeys, AreToldHowTheyAreWrittenToday) {
  const auto notices = [](const std::string& coupling, const Lines& overrides = {}) {
    return case_with(coupling, overrides).notices;
  };
  EXPECT_EQ(notices("scheme = \"smoothed\"\n"), Lines{});
  EXPECT_EQ(notices("exchange = \"smoothed\"\n"),
            Lines{"case.toml:15: [coupling] exchange = \"smoothed\": has become coupling.scheme; "
                  "today: coupling.scheme = \"smoothed\""});
  const std::string became =
      ": has become coupling.scheme; today: coupling.scheme = \"centred\", "
      "coupling.centred.void_fraction = \"centre\"";
  EXPECT_EQ(notices("exchange = \"interpolated\"\n", {"coupling.void_fraction=centre"}),
            (Lines{"case.toml:15: [coupling] exchange = \"interpolated\"" + became,
                   "--set coupling.void_fraction = \"centre\"" + became}));
  EXPECT_EQ(notices("void_fraction = \"centre\"\n"),
            Lines{"case.toml:15: [coupling] void_fraction = \"centre\"" + became +
                  " (it always was: by_row has no \"centre\")"});
  const Case of_before = case_with("exchange = \"by_row\"\n");
  EXPECT_EQ(case_warnings(of_before, of_before.sizes), of_before.notices);
}

TEST(OldKeys, ChangeASchemeThatAnEarlierLayerSets) {
  EXPECT_EQ(chosen("scheme = \"layered\"\n", {"coupling.exchange=smoothed"}),
            coupling_of(test::kSchemes[3]));
  EXPECT_EQ(chosen("scheme = \"smoothed\"\n", {"coupling.void_fraction=centre"}),
            coupling_of(test::kSchemes[4]));
  EXPECT_EQ(chosen("scheme = \"cfdem\"\n", {"coupling.exchange=smoothed"}),
            coupling_of(test::kSchemes[6]));
  EXPECT_EQ(chosen("scheme = \"centred\"\ncentred.void_fraction = \"centre\"\n",
                   {"coupling.void_fraction=divided"}),
            coupling_of(test::kSchemes[1]));
  EXPECT_EQ(
      chosen("exchange = \"smoothed\"\nvoid_fraction = \"centre\"\n", {"coupling.scheme=layered"}),
      coupling_of(test::kSchemes[0]));
}

TEST(OldKeys, AreRefusedWhereTheyCannotBeMeant) {
  const auto refused = [](const std::string& coupling, const std::string& line) {
    EXPECT_EQ(test::problems(coupled_case() + "[coupling]\n" + coupling), test::only(line));
  };
  refused("exchange = \"by_roe\"\n",
          "case.toml:15: [coupling] exchange = \"by_roe\": must be \"by_row\", \"interpolated\", "
          "\"smoothed\"; today the key is coupling.scheme");
  refused("void_fraction = 3\n",
          "case.toml:15: [coupling] void_fraction = 3: must be \"divided\", \"cfdem_faithful\", "
          "\"centre\"; today the key is coupling.scheme");
  refused("scheme = \"layered\"\nexchange = \"smoothed\"\n",
          "case.toml:16: [coupling] exchange = \"smoothed\": has become coupling.scheme; today: "
          "coupling.scheme = \"smoothed\"; and scheme is set, too");
}

}  // namespace
}  // namespace barchan
