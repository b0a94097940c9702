// Numbers that nobody means, what is no text, and names that a terminal must not obey.
#include <gtest/gtest.h>

#include "src/base/printable.hpp"
#include "src/config/toml_hint.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::grain_case;
using test::Lines;
using test::only;
using test::problems;

TEST(ConfigPlausible, NumbersThatOverflowWhatFollowsFromThem) {
  EXPECT_EQ(problems(grain_case("density = 1e300\n")),
            only("case.toml:10: [grains] density = 1e+300: must be at most 1e+09 kg/m3 to be "
                 "computed with"));
  EXPECT_EQ(problems(grain_case("youngs_modulus = 1e-300\n")),
            only("case.toml:10: [grains] youngs_modulus = 1e-300: must be at least 0.001 Pa to "
                 "be computed with"));
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

TEST(ConfigPlausible, WhatIsNoTomlIsToldWithItsLikelyCause) {
  const auto says = [](const std::string& text, const std::string& words) {
    const Lines lines = problems(text);
    ASSERT_EQ(lines.size(), 2u) << text.substr(0, 100);
    EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
  };
  says("\xFF\xFE[", "case.toml:1: not TOML: it is UTF-16 text; save it as UTF-8");
  says(std::string("[time]\ne\0nd = 1\n", 16), "case.toml:2: not TOML: it holds a NUL byte");
  says("[time]\nend = 0,5\n", "decimals come after a point");
  says("[time]\nend = .5\n", "both sides of the point");
  says("[time]\nend = 5d-1\n", "exponents are written with e");
  says("[time]\nend = 5 s\n", "without a unit");
  says("[time]\nend = True\n", "true and false are lower case");
  says("[time]\nend = \"C:\\q\"\n", "a backslash");
  std::string deep = "a";
  for (int n = 0; n < 100000; ++n) deep += ".a";
  says(deep + " = 1\n", "case.toml:1: not TOML: a key of so many parts");
  says("[" + deep + "]\n", "case.toml:1: not TOML: a key of so many parts");
  EXPECT_TRUE(is_too_deep(deep));
  EXPECT_EQ(problems(fluid_case(), {deep + "=1"}).size(), 2u);
  // Points in values, strings and comments join no keys.
  EXPECT_EQ(unparsable("x = [.1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1, .1]\n"
                       "# ......................\ny = \"......................\"\n")
                .line,
            0);
}

TEST(ConfigPlausible, ATitleIsText) {
  EXPECT_EQ(
      problems("case.title = \"a\\u001Bb\"\n" + fluid_case()),
      only("case.toml:1: [case] title = \"a\\u001Bb\": must be text without control characters"));
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
