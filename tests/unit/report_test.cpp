#include "src/base/report.hpp"

#include <gtest/gtest.h>

#include "src/base/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

struct Said {
  std::string out, err, log;  // log.txt; empty if there is none
};

template <class Talk>
Said heard(const Talk& talk, report::Shown shown = report::Shown::progress, int rank = 0) {
  const TemporaryFolder folder;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  report::start(shown, rank);
  report::log_to(folder / "log.txt", false);
  talk();
  report::stop_log();
  report::start(report::Shown::progress);
  return {.out = testing::internal::GetCapturedStdout(),
          .err = testing::internal::GetCapturedStderr(),
          .log = exists(folder / "log.txt") ? read_text(folder / "log.txt") : ""};
}

void say_all() {
  report::info("grains {}", 3000);
  report::warn("step is {:.1f} % of the limit", 25.0);
  report::error("disk full");
}

const std::string warnings = "warning: step is 25.0 % of the limit\nerror: disk full\n";

TEST(Report, LinesGoToTheTerminalAndTheLog) {
  const Said said = heard(say_all);
  EXPECT_EQ(said.out, "grains 3000\n");
  EXPECT_EQ(said.err, warnings);
  EXPECT_EQ(said.log, said.out + warnings);
}

TEST(Report, QuietHidesInformationButLogsIt) {
  const Said said = heard(say_all, report::Shown::problems);
  EXPECT_EQ(said.out, "");
  EXPECT_EQ(said.err, warnings);
  EXPECT_EQ(said.log, "grains 3000\n" + warnings);
}

TEST(Report, DetailsGoToTheLogAndToWhoAsksForThem) {
  const auto say = [] { report::details("CFL 0.1"); };
  for (const auto shown : {report::Shown::progress, report::Shown::details}) {
    const Said said = heard(say, shown);
    EXPECT_EQ(said.out, shown == report::Shown::details ? "CFL 0.1\n" : "");
    EXPECT_EQ(said.log, "CFL 0.1\n");
  }
}

TEST(Report, OtherRanksAreSilent) {
  const Said said = heard(say_all, report::Shown::progress, 1);
  EXPECT_EQ(said.out + said.err + said.log, "");
}

TEST(Report, TheLogIsContinuedOrReplaced) {
  const TemporaryFolder folder;
  const auto log_line = [&](bool append) {
    heard([&] {
      report::log_to(folder / "log.txt", append);
      report::info("line");
    });
  };
  log_line(false);
  log_line(true);
  EXPECT_EQ(read_text(folder / "log.txt"), "line\nline\n");
  log_line(false);
  EXPECT_EQ(read_text(folder / "log.txt"), "line\n");
}

TEST(Report, TheLogOfAForeignFolderLeadsNowhereElse) {
  const TemporaryFolder folder;
  for (const bool append : {true, false}) {
    write_atomically(folder / "precious", "text");
    std::filesystem::create_symlink(folder / "precious", folder / "log.txt");
    heard([&] {
      report::log_to(folder / "log.txt", append);
      report::info("line");
    });
    EXPECT_EQ(read_text(folder / "precious"), "text");
    EXPECT_EQ(read_text(folder / "log.txt"), "line\n");
    std::filesystem::remove(folder / "log.txt");
  }
}

TEST(Progress, ShowsWhatARunHas) {
  Progress p{.t = 2.5, .t_start = 0, .t_end = 10};
  EXPECT_EQ(format_progress(p, -1), "25 %  t 2.5 s");
  p.grain_steps_per_second = 17.3e6;
  p.list_rebuilds = 0.625;
  p.n_grains = 98765;
  EXPECT_EQ(format_progress(p, 185), "25 %  left 3 min 05 s  t 2.5 s  grains 98765");
  p.cell_steps_per_second = 9.1e6;
  p.cfl = 0.051;
  p.pressure_iterations = 4.96;
  p.dune_width = 0.0451;
  p.dune_length = 0.06;
  const std::string line = "25 %  left 3 min 05 s  t 2.5 s  W 45.1 mm  L 60.0 mm  CFL 0.051";
  EXPECT_EQ(format_progress(p, 185), line);
  EXPECT_EQ(format_details(p, 185),
            line +
                "  grains 98765  17.30 M grain-steps/s  0.62 lists/step  9.10 M cell-steps/s  "
                "p-it 5.0");
}

TEST(Progress, TheLongestLineFitsATerminal) {
  const Progress p{.t = 1234.5678,
                   .t_start = 0,
                   .t_end = 1e4,
                   .grain_steps_per_second = 1,
                   .cell_steps_per_second = 1,
                   .cfl = 0.12345,
                   .n_grains = 123'456'789,
                   .dune_width = 1.23456,
                   .dune_length = 1.23456};
  EXPECT_LT(format_progress(p, 3599).size(), 80);
}

TEST(Progress, DurationsRead) {
  EXPECT_EQ(format_duration(0.2), "0 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(2 * 3600 + 7 * 60), "2 h 07 min");
  EXPECT_EQ(format_duration(4 * 86400 + 3 * 3600), "4 d 03 h");
  EXPECT_EQ(format_duration(1e300), "?");
  EXPECT_EQ(format_duration(-1), "?");
}

TEST(ProgressLine, PrintsPlainLinesNowAndThenWhereThereIsNoTerminal) {
  const Progress p{.t = 2, .t_start = 0, .t_end = 2};
  const Said said = heard([&] {
    ProgressLine(std::chrono::hours(1)).update(p);
    ProgressLine(std::chrono::milliseconds(0)).update(p);
  });
  EXPECT_EQ(said.out, "100 %  left 0 s  t 2 s\n");
  EXPECT_EQ(said.log, said.out);
}

TEST(ProgressLine, QuietShowsNone) {
  const auto talk = [] { ProgressLine(std::chrono::milliseconds(0)).update({.t = 1, .t_end = 2}); };
  EXPECT_EQ(heard(talk, report::Shown::problems).out, "");
}

}  // namespace
}  // namespace barchan
