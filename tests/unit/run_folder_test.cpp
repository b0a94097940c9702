#include "src/run/run_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/atomic_file.hpp"
#include "src/base/stopwatch.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const std::string history_header =
    "t,step,u_star,bulk_velocity,pressure_gradient,fluid_kinetic_energy,grain_kinetic_energy,cfl,"
    "continuity_residual,pressure_iterations,n_grains,n_contacts,max_overlap\n";
const std::string dune_header =
    "t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost,flux\n";

HistoryRow history_row(double t) {
  HistoryRow row;
  row.t = t;
  row.step = 400;
  row.u_star = 0.0168;
  row.n_grains = 99999;
  return row;
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(AtomicFile, ReplacesTheWholeFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", "a long first version\n");
  write_atomically(folder / "a.txt", "second\n");
  EXPECT_EQ(read_text(folder / "a.txt"), "second\n");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, AFailedWriteKeepsTheOldContent) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", "old");
  const FileSizeLimit full(100);
  const auto text =
      message_of([&] { write_atomically(folder / "a.txt", std::string(10000, 'x')); });
  EXPECT_EQ(text, "cannot write " + (folder / "a.txt").string() + ": File too large");
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, SaysWhatItCannotReach) {
  const TemporaryFolder folder;
  const auto path = (folder / "no/a.txt").string();
  EXPECT_NE(message_of([&] { write_atomically(path, "x"); }).find("No such file"),
            std::string::npos);
  EXPECT_EQ(message_of([&] { read_text(path); }),
            "cannot read " + path + ": No such file or directory");
  EXPECT_EQ(message_of([&] { read_text(folder.path()); }),
            "cannot read " + folder.path().string() + ": Is a directory");
}

TEST(RunFolder, WritesTablesInTheDocumentedFormat) {
  const TemporaryFolder folder;
  RunFolder run(folder / "runs/x", {});
  EXPECT_EQ(read_text(run.file("history.csv")), history_header);
  EXPECT_EQ(read_text(run.file("dune.csv")), dune_header);
  run.append(history_row(0.1));
  DuneRow dune;
  dune.t = 0.1;
  dune.n_grains = 3000;
  dune.w = 0.04;
  dune.n_lost = 7;
  dune.flux = 2e-6;
  run.append(dune);
  EXPECT_EQ(read_text(run.file("history.csv")),
            history_header + "0.1,400,0.0168,0,0,0,0,0,0,0,99999,0,0\n");
  EXPECT_EQ(read_text(run.file("dune.csv")),
            dune_header + "0.1,0,3000,0.04,0,0,0,0,0,0,0,0,0,0,7,2e-06\n");
  run.write_config("[case]\n");
  EXPECT_EQ(read_text(run.file("config.toml")), "[case]\n");
}

TEST(RunFolder, ARestartCutsTheTables) {
  const TemporaryFolder folder;
  {
    RunFolder run(folder.path(), {});
    for (int n = 1; n <= 10; ++n) run.append(history_row(n * (1.0 / 3.0)));
    std::ofstream(run.file("history.csv"), std::ios::app) << "3.66,40";  // killed while writing
  }
  RunFolder run(folder.path(), 5 * (1.0 / 3.0));
  const std::string text = read_text(run.file("history.csv"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 5);
  EXPECT_NE(text.find("\n1.666666667,"), std::string::npos);
  run.append(history_row(2.0));
  EXPECT_TRUE(
      read_text(run.file("history.csv")).ends_with("\n2,400,0.0168,0,0,0,0,0,0,0,99999,0,0\n"));
}

TEST(RunFolder, CutTableHandlesMissingEmptyAndForeignFiles) {
  const TemporaryFolder folder;
  cut_table(folder / "new.csv", "t,a", 1.0);
  EXPECT_EQ(read_text(folder / "new.csv"), "t,a\n");
  std::ofstream(folder / "empty.csv").close();
  cut_table(folder / "empty.csv", "t,a", 1.0);
  EXPECT_EQ(read_text(folder / "empty.csv"), "t,a\n");
  std::ofstream(folder / "half.csv") << "t,";  // killed while the header was written
  cut_table(folder / "half.csv", "t,a", 1.0);
  EXPECT_EQ(read_text(folder / "half.csv"), "t,a\n");
  std::ofstream(folder / "other.csv") << "t,b\n1,2\n";
  EXPECT_THROW(cut_table(folder / "other.csv", "t,a", 1.0), std::runtime_error);
  EXPECT_EQ(read_text(folder / "other.csv"), "t,b\n1,2\n");
  std::ofstream(folder / "bad.csv") << "t,a\n0,1\n1\nx,2\n0.5,3,4\n1,5\n2,6\n";
  cut_table(folder / "bad.csv", "t,a", 1.0);
  EXPECT_EQ(read_text(folder / "bad.csv"), "t,a\n0,1\n1,5\n");
}

TEST(RunFolder, ANewRunRemovesOnlyResults) {
  const TemporaryFolder folder;
  for (const char* name : {"fields.h5", "grains.h5", "fields.xdmf", "restart_0000000100.h5",
                           "restart_0000000200.h5.tmp", "run.json", "log.txt", "notes.md",
                           "picture.png", "restart_mine.h5"}) {
    std::ofstream(folder / name) << "x";
  }
  const RunFolder run(folder.path(), {});
  EXPECT_EQ(files_in(folder.path()),
            (std::vector<std::string>{"dune.csv", "history.csv", "notes.md", "picture.png",
                                      "restart_mine.h5"}));
}

TEST(RunFolder, ARestartKeepsResults) {
  const TemporaryFolder folder;
  std::ofstream(folder / "fields.h5") << "x";
  std::ofstream(folder / "restart_0000000100.h5") << "x";
  const RunFolder run(folder.path(), 1.0);
  EXPECT_TRUE(std::filesystem::exists(folder / "fields.h5"));
  EXPECT_TRUE(std::filesystem::exists(folder / "restart_0000000100.h5"));
}

TEST(RunFolder, ProblemsNameTheFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const auto text = message_of([&] { RunFolder(folder / "file/run", {}); });
  EXPECT_NE(text.find("cannot make the folder " + (folder / "file/run").string()),
            std::string::npos)
      << text;
  RunFolder run(folder / "run", {});
  const FileSizeLimit full(history_header.size() + 10);
  EXPECT_EQ(message_of([&] { run.append(history_row(0.5)); }),
            "cannot write " + run.file("history.csv").string() + ": File too large");
}

TEST(RunFolder, TheSummaryIsJsonWhateverItsNumbersAndTexts) {
  const TemporaryFolder folder;
  RunFolder run(folder.path(), {});
  run.write_summary({{"status", "done"},
                     {"title", "Quick \"start\""},
                     {"message", "bad bytes \xff in a path"},
                     {"phases", Phases{{"grains", 0.02}, {"pressure", 0.01}}},
                     {"max_cfl", std::nan("")}});
  const auto json = nlohmann::json::parse(read_text(run.file("run.json")));
  EXPECT_EQ(json.at("title"), "Quick \"start\"");
  EXPECT_EQ(json.at("phases").at("pressure"), 0.01);
  EXPECT_TRUE(json.at("max_cfl").is_null());
  EXPECT_EQ(status_in(run.file("run.json")), "done");
  EXPECT_EQ(status_in(run.file("config.toml")), "");
}

TEST(RunFolder, SummaryIsReplacedAsAWhole) {
  const TemporaryFolder folder;
  RunFolder run(folder.path(), {});
  run.write_summary({{"message", std::string(1000, 'm')}});
  run.write_summary({{"message", ""}});
  EXPECT_EQ(read_text(run.file("run.json")), "{\n  \"message\": \"\"\n}\n");
}

}  // namespace
}  // namespace barchan
