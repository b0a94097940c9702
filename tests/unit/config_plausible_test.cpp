// Numbers that nobody means, what is no text, and names that a terminal must not obey.
#include <gtest/gtest.h>

#include "src/base/words.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::grain_case;
using test::Lines;
using test::problems;
using test::refused;

TEST(ConfigPlausible, NumbersThatOverflowWhatFollowsFromThem) {
  refused(
      grain_case("density = 1e300\n"),
      "case.toml:10: [grains] density = 1e+300: must be at most 1e+09 kg/m3 to be computed with");
  refused(grain_case("youngs_modulus = 1e-300\n"),
          "case.toml:10: [grains] youngs_modulus = 1e-300: must be at least 0.001 Pa to be "
          "computed with");
  EXPECT_EQ(problems(fluid_case("top = \"no_slip\"\ntop_velocity = -1e300\n")).size(), 2u);
  EXPECT_EQ(problems(grain_case(), {"domain.size=[1e300, 1, 1]"}).size(), 2u);
}

TEST(ConfigPlausible, StepsAreCountedInTenDigits) {
  const auto with = [](const char* end) {
    return std::vector<std::string>{"time.fluid_step=1e-3", "output.history_interval=1e-3",
                                    std::string("time.end=") + end};
  };
  EXPECT_TRUE(problems(fluid_case(), with("9999999.999")).empty());
  const Lines refused = problems(fluid_case(), with("1e7"));
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_NE(refused[0].find("which is 9999999999 fluid steps"), std::string::npos) << refused[0];
}

TEST(ConfigPlausible, WhatIsNoTomlIsToldWithItsLine) {
  const auto says = [](const std::string& text, const std::string& words) {
    const Lines lines = problems(text);
    ASSERT_EQ(lines.size(), 2u) << text.substr(0, 100);
    EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
  };
  says("\xFF\xFE[", "case.toml:1: not TOML: ");
  says(std::string("[time]\ne\0nd = 1\n", 16), "case.toml:2: not TOML: it holds a NUL byte");
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

TEST(ConfigPlausible, ATitleIsText) {
  refused("case.title = \"a\\u001Bb\"\n" + fluid_case(),
          "case.toml:1: [case] title = \"a\\u001Bb\": must be text without control characters");
  EXPECT_EQ(problems("case.title = \"" + std::string(201, 'a') + "\"\n" + fluid_case()).size(), 2u);
  EXPECT_TRUE(problems("case.title = \"D\xC3\xBCne\"\n" + fluid_case()).empty());
}

TEST(ConfigPlausible, OnlySoManyProblemsAreTold) {
  std::string many = fluid_case();
  for (int n = 0; n < 1000; ++n) many += "key_" + std::to_string(n) + " = 1\n";
  const Lines lines = problems(many);
  ASSERT_EQ(lines.size(), 32u);
  EXPECT_EQ(lines[30], "  ... and 970 more");
  EXPECT_EQ(lines[31], "1000 problems; nothing was run.");
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
