// A section that may be written many times, made up here: the table of keys knows how to read,
// check, write, compare and document it. A key is one line.
#include <gtest/gtest.h>

#include "src/case/case_values.hpp"
#include "src/case/resolved.hpp"
#include "src/toml/key_builder.hpp"
#include "src/toml/keys_page.hpp"
#include "src/toml/reading.hpp"
#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

const Sections& table() {
  static const Sections all = [] {
    Sections made;
    Section section{.name = "ambient", .meaning = "Around them"};
    Keys ambient(section, [](auto& c) { return &c; });
    ambient("title", &Config::title, at_most(10), "", "of the case");
    made.push_back(section);
    Section& size = made.emplace_back(Section{.name = "size", .meaning = "Grains of one size"});
    auto key = repeated_keys(size, [](auto& c) { return c.grains ? &c.grains->sizes : nullptr; });
    key("diameter", &SizeClass::diameter, above(0).at_most(1), "m", "how wide they are", required);
    key("count", &SizeClass::count, at_least(1), "", "how many", fixed_by_restart);
    size.prepare = [](Config& c, bool) { c.grains.emplace(); };
    return made;
  }();
  return all;
}

Config read(const std::string& text, std::vector<std::string>& problems,
            const std::vector<std::string>& set = {}) {
  ConfigReader reader(text, "case.toml", table());
  reader.set(set);
  Config config;
  reader.read(config);
  for (const Problem& p : reader.problems()) problems.push_back(to_string(p.where) + ": " + p.text);
  return config;
}

TEST(RepeatedSection, IsReadAndWrittenAsOftenAsItIsThere) {
  std::vector<std::string> problems;
  const Config c = read(
      "[[size]]\ndiameter = 2e-4\ncount = 7\n[[size]]\ndiameter = 3e-4\ncount = 1\n", problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(c.grains->sizes, (std::vector<SizeClass>{{2e-4, 7}, {3e-4, 1}}));
  const std::string text = to_toml(c, table());
  EXPECT_NE(text.find("[[size]]\ndiameter = 0.0002\ncount = 7\n\n[[size]]\ndiameter = 0.0003\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(read(text, problems).grains->sizes, c.grains->sizes);
  EXPECT_TRUE(read("", problems).grains->sizes.empty());
  EXPECT_EQ(read("", problems, {"size=[{diameter = 1e-4, count = 2}]"}).grains->sizes,
            (std::vector<SizeClass>{{1e-4, 2}}));
  EXPECT_EQ(problems, std::vector<std::string>());
}

TEST(RepeatedSection, EachMistakeIsToldWhereItIs) {
  std::vector<std::string> problems;
  read("[[size]]\ndiameter = 2e-4\n[[size]]\ncount = 0\n[[size]]\ndiameter = -1\ndiametre = 2\n",
       problems);
  EXPECT_EQ(problems,
            (std::vector<std::string>{
                "case.toml:3: [size] diameter: required key is missing",
                "case.toml:4: [size] count = 0: must be at least 1",
                "case.toml:6: [size] diameter = -1: must be above 0 and at most 1",
                "case.toml:7: [size] diametre: unknown key (did you mean \"diameter\"?)"}));
  problems.clear();
  read("[size]\ndiameter = 2e-4\n", problems);
  EXPECT_EQ(problems, (std::vector<std::string>{
                          "case.toml:1: [size]: must be sections, [[size]] for each of them"}));
}

// A comparison of each of 3,000 with all before it made 4,498,501 problems.
TEST(RepeatedSection, TooManyAreOneProblem) {
  for (const std::string name : {"initial.heap", "body", "grains.kind", "grains.pair"}) {
    std::string text = test::grain_case();
    if (name == "initial.heap") text.erase(text.find("grains = {"), text.find("}") + 3);
    for (int n = 0; n < 3000; ++n)
      text += "[[" + name + "]]\nname = \"a\"\nkinds = [\"a\", \"a\"]\n";
    const test::Lines lines = test::problems(text);
    const auto most = std::ranges::count_if(lines, [&](const std::string& line) {
      return line.find("must be at most ") != std::string::npos;
    });
    EXPECT_EQ(most, 1) << name;
  }
}

TEST(RepeatedSection, ARestartComparesAllOfThem) {
  std::vector<std::string> problems;
  const Config a = read("[[size]]\ndiameter = 2e-4\ncount = 7\n", problems);
  const Config b = read(
      "[[size]]\ndiameter = 2e-4\ncount = 8\n[[size]]\ndiameter = 3e-4\ncount = 1\n", problems);
  EXPECT_EQ(restart_conflicts(a, b, table()),
            (std::vector<std::string>{"size.count = 7: it was written with 8, 1"}));
  EXPECT_EQ(changed_keys(a, b, table()),
            (std::vector<std::string>{"size.diameter 0.0002, 0.0003 -> 0.0002"}));
  EXPECT_TRUE(restart_conflicts(b, b, table()).empty());
}

TEST(RepeatedSection, ThePageHasItOnce) {
  const std::string page = keys_page(table());
  EXPECT_NE(page.find("\n## [[size]]\n\nGrains of one size"), std::string::npos);
  EXPECT_NE(page.find("| `diameter` | number, above 0 and at most 1 [m] | required | how wide"),
            std::string::npos);
}

}  // namespace
}  // namespace barchan
