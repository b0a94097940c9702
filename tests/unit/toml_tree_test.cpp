// Texts that reach the parser of TOML, and those that are kept from it: strings and comments by the
// grammar.
#include "src/toml/toml_tree.hpp"

#include <gtest/gtest.h>

#include "tests/support/config_problems.hpp"

namespace barchan {
namespace {

using test::fluid_case;
using test::problems;

const std::string kParts = [] {
  std::string text;
  for (int n = 0; n < 25000; ++n) text += ".a";
  return text;
}();

/// The line of the problem of too many parts; 0: there is none.
int line_of_parts(const std::string& text) {
  std::vector<Problem> found;
  parse_toml(text, "case.toml", found);
  for (const Problem& problem : found)
    if (problem.text.find("a key of so many parts") != std::string::npos) return problem.where.line;
  return 0;
}

TEST(TomlTree, NoStringHidesThePartsOfAKey) {
  const char* first_parts[] = {"a",        "\"a\"",        "\"\\\"\"", "'\"'",  "\"'\"",
                               "\"\\\\\"", "\"\\\\\\\"\"", "'\\'",     "\"#\"", "\"a\\u0022b\"",
                               "\"\"",     "''",           "\".\" ",   "\"[\" "};
  for (const std::string first : first_parts) {
    EXPECT_EQ(line_of_parts(first + kParts + " = 1\n"), 1) << first;
    EXPECT_EQ(line_of_parts("[" + first + kParts + "]\n"), 1) << first;
    EXPECT_EQ(line_of_parts("x = { " + first + kParts + " = 1 }\n"), 1) << first;
  }
  // The same text behind strings of each kind, over many lines as well, and a comment.
  const char* before[] = {"a = \"\\\"\"",
                          "a = '\\'",
                          "a = \"\"\"\n\\\"\"\"\\\"\n\"\"\"",
                          "a = '''\n''\\'''",
                          "a = \"\"\"x\"\"\"\"\"",
                          "a = '''x'''''",
                          "a = \"\"\"\"\"\"",
                          "a = \"\" # \"",
                          "a = \"\"\"\\\\\"\"\"",
                          "a = [ '\"', \"'\" ]"};
  for (const std::string text : before) {
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    std::vector<Problem> found;
    parse_toml(text + "\n", "case.toml", found);
    EXPECT_TRUE(found.empty()) << text << ": " << found.front().text;
    EXPECT_EQ(line_of_parts(text + "\nb" + kParts + " = 1\n"), lines + 2) << text;
  }
}

TEST(TomlTree, PointsInTextJoinNoParts) {
  const std::string points(40, '.');
  for (const std::string quotes : {"\"\"\"", "'''"}) {
    const std::string notes = "\nContents\nSteps " + points + " 5\n'quoted' " + points + "\n";
    EXPECT_TRUE(
        problems("[case]\nnotes = " + quotes + notes + quotes + "\n" + fluid_case()).empty());
  }
  EXPECT_TRUE(problems("[case]\nnotes = \"\"\"\\\n  " + points + "\\\"\"\"\\\"" + points +
                       "\"\"\" # " + points + "\n" + fluid_case())
                  .empty());
  EXPECT_TRUE(
      problems("[case]\ntitle = '\\" + points + "' # \"" + points + "\n" + fluid_case()).empty());
}

TEST(TomlTree, ALongLineTakesNoTime) {
  std::vector<Problem> found;
  parse_toml(
      "a = [" + std::string(3'000'000, ' ') + "]\nb = \"" + std::string(3'000'000, '\'') + '"',
      "case.toml", found);
  EXPECT_TRUE(found.empty());
}

TEST(TomlTree, TheDeepestThatPassesFitsTheStack) {
  // Tables within tables as deep as the parser takes them, each by as long a key as may be.
  std::string text = "x = ";
  for (int n = 0; n < 250; ++n) text += "{ a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = ";
  text += "1" + std::string(250, '}') + "\n";
  std::vector<Problem> found;
  const Node tree = parse_toml(text, "case.toml", found);
  EXPECT_TRUE(found.empty()) << found.front().text;
  EXPECT_NE(tree.find("x.a.a.a.a"), nullptr);
}

}  // namespace
}  // namespace barchan
