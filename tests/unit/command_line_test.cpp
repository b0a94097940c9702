#include "src/app/command_line.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

CommandLine parse(std::vector<const char*> words) {
  words.insert(words.begin(), "barchan");
  return parse_command_line(static_cast<int>(words.size()), words.data(), "barchan 1.2.3 (abc)");
}

void expect_bad(const std::vector<const char*>& words, const std::string& text) {
  const std::string told = message_of([&] { parse(words); });
  EXPECT_NE(told.find(text), std::string::npos) << told;
}

TEST(CommandLine, RunWithNothingElse) {
  const CommandLine line = parse({"run", "case.toml"});
  EXPECT_EQ(line.command, Command::run);
  EXPECT_EQ(line.file, "case.toml");
  EXPECT_TRUE(line.overrides.empty());
  EXPECT_FALSE(line.out.has_value());
  EXPECT_FALSE(line.restart.has_value());
  EXPECT_EQ(line.threads, 0);
  EXPECT_EQ(line.patience, 600);
  EXPECT_FALSE(line.dry_run);
  EXPECT_FALSE(line.resume);
  EXPECT_TRUE(parse({"run", "case.toml", "--resume"}).resume);
  EXPECT_EQ(line.shown, report::Shown::progress);
}

TEST(CommandLine, RunWithAll) {
  const CommandLine line =
      parse({"run", "--set", "fluid.cells=[8,9,10]", "case.toml", "--out", "a dir",
             "--restart=r.h5", "--threads", "3", "--set", "case.title=a b", "--patience", "20",
             "--dry-run", "--quiet", "--set=time.end=-1"});
  EXPECT_EQ(line.command, Command::run);
  EXPECT_EQ(line.file, "case.toml");
  EXPECT_EQ(line.overrides,
            (std::vector<std::string>{"fluid.cells=[8,9,10]", "case.title=a b", "time.end=-1"}));
  EXPECT_EQ(line.out, "a dir");
  EXPECT_EQ(line.restart, "r.h5");
  EXPECT_EQ(line.threads, 3);
  EXPECT_EQ(line.patience, 20);
  EXPECT_TRUE(line.dry_run);
  EXPECT_EQ(line.shown, report::Shown::problems);
}

TEST(CommandLine, CheckAndInfo) {
  const CommandLine check =
      parse({"check", "case.toml", "--set", "time.end=1", "--threads", "2", "--out", "runs/a"});
  EXPECT_EQ(check.threads, 2);
  EXPECT_EQ(check.out, "runs/a");
  EXPECT_EQ(check.command, Command::check);
  EXPECT_EQ(check.file, "case.toml");
  EXPECT_EQ(check.overrides, std::vector<std::string>{"time.end=1"});
  const CommandLine info = parse({"info", "grains.h5"});
  EXPECT_EQ(info.command, Command::info);
  EXPECT_EQ(info.file, "grains.h5");
}

TEST(CommandLine, VersionAndHelpEndWell) {
  const CommandLine version = parse({"--version"});
  EXPECT_EQ(version.command, Command::none);
  EXPECT_NE(version.text.find("barchan 1.2.3 (abc)"), std::string::npos);
  const CommandLine help = parse({"run", "--help"});
  EXPECT_EQ(help.command, Command::none);
  EXPECT_NE(help.text.find("--restart"), std::string::npos) << help.text;
}

TEST(CommandLine, BadUsageIsToldAsSuch) {
  expect_bad({}, "subcommand is required");
  expect_bad({"rnu", "case.toml"},
             "unknown command \"rnu\" (did you mean \"run\"?); there are run, check, new, info");
  expect_bad({"run"}, "CASE is required");
  expect_bad({"run", "a.toml", "b.toml"}, "b.toml");
  expect_bad({"run", "a.toml", "--sett", "a=1"}, "--sett");
  expect_bad({"run", "a.toml", "--threads", "many"}, "--threads");
  expect_bad({"run", "a.toml", "--threads", "0"}, "--threads");
  expect_bad({"run", "a.toml", "--threads", "513"}, "--threads");
  expect_bad({"run", "a.toml", "--patience", "-1"}, "--patience");
  expect_bad({"run", "a.toml", "--patience", "soon"}, "--patience");
  expect_bad({"run", "a.toml", "--set"}, "--set");
  expect_bad({"run", "a.toml", "--set", "a.b", "0.4"},
             "--set a.b has no value: write --set a.b=VALUE");
  expect_bad({"run", "a.toml", "--quiet", "--verbose"}, "--quiet");
  expect_bad({"check", "a.toml", "--restart", "r.h5"}, "--restart");
  expect_bad({"run", "a.toml", "--resume", "--restart", "r.h5"}, "--resume");
  expect_bad({"run", "a.toml", "--resume", "--overwrite"}, "--resume");
  expect_bad({"info"}, "PATH is required");
}

}  // namespace
}  // namespace barchan
