// Run folders: where results cannot go is told before anything is computed, and nothing that is
// needed is removed; the tables, the summary and what a restart makes of them.
#include "src/run/run_folder.hpp"
#include "src/run/folder_checks.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/atomic_file.hpp"
#include "src/base/stopwatch.hpp"
#include "src/case/resolved.hpp"
#include "src/diagnostics/dune_table.hpp"
#include "src/diagnostics/heap_shares.hpp"
#include "src/io/seal.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/history_table.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const std::string history_header =
    "t,step,u_star,bulk_velocity,pressure_gradient,fluid_kinetic_energy,grain_kinetic_energy,cfl,"
    "continuity_residual,pressure_iterations,n_grains,n_contacts,max_overlap,grain_flux,"
    "stress_on_grains,grain_step_over_stable,bulk_velocity_z,wanted_velocity_x,wanted_velocity_z,"
    "pressure_gradient_z,grain_flux_z,stress_on_grains_z,n_fed\n";
const std::string dune_header =
    "t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost,flux,"
    "horn_left_2d,horn_right_2d\n";

HistoryRecord history_record(double t) {
  return {.t = t, .step = 400, .u_star = 0.0168, .n_grains = 99999};
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(AtomicFile, AFailedWriteKeepsTheOldContent) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", "longer, and replaced as a whole");
  write_atomically(folder / "a.txt", "old");
  const FileSizeLimit full(100);
  const auto text =
      message_of([&] { write_atomically(folder / "a.txt", std::string(10000, 'x')); });
  EXPECT_EQ(text, "cannot write " + (folder / "a.txt").string() + ": File too large");
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder.path()), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, ALinkInItsWayIsNotFollowed) {
  const TemporaryFolder folder;
  write_atomically(folder / "victim", "of others");
  std::filesystem::create_symlink("victim", folder / "a.txt.tmp");
  write_atomically(folder / "a.txt", "ours");
  EXPECT_EQ(read_text(folder / "victim"), "of others");
  EXPECT_EQ(read_text(folder / "a.txt"), "ours");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "a.txt"));
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
  const auto run = prepare_folder(folder / "runs/x", {});
  append_record(run, history_record(0.1));
  DuneRecord dune;
  dune.t = 0.1;
  dune.n_grains = 3000;
  dune.w = 0.04;
  dune.n_lost = 7;
  dune.flux = 2e-6;
  dune.horn_right_2d = 0.003;
  append_record(run, dune);
  EXPECT_EQ(read_text(run / "history.csv"),
            history_header + "0.1,400,0.0168,0,0,0,0,0,0,0,99999,0,0,0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(read_text(run / "dune.csv"),
            dune_header + "0.1,0,3000,0.04,0,0,0,0,0,0,0,0,0,0,7,2e-06,0,0.003\n");
}

TEST(RunFolder, ARestartCutsTheTables) {
  const TemporaryFolder folder;
  const auto table = folder / "history.csv";
  prepare_folder(folder.path(), {});
  for (int n = 1; n <= 10; ++n) append_record(folder.path(), history_record(n * (1.0 / 3.0)));
  std::ofstream(table, std::ios::app) << "3.66,40";  // killed while writing
  prepare_folder(folder.path(), 5 * (1.0 / 3.0));
  const std::string text = read_text(table);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 5);
  EXPECT_NE(text.find("\n1.666666667,"), std::string::npos);
  append_record(folder.path(), history_record(2.0));
  EXPECT_TRUE(
      read_text(table).ends_with("\n2,400,0.0168,0,0,0,0,0,0,0,99999,0,0,0,0,0,0,0,0,0,0,0,0\n"));
}

TEST(RunFolder, TheTableOfHeapsIsMadeByItsFirstLineAndCutAtARestart) {
  const TemporaryFolder folder;
  const auto file = folder / "heaps.csv";
  const std::string header = "t,dune,heap,n_grains,volume\n";
  prepare_folder(folder.path(), {});
  EXPECT_FALSE(std::filesystem::exists(file));
  append_record(folder.path(), HeapShare{.t = 1, .dune = -1, .heap = 2, .n_grains = 3});
  append_record(folder.path(), HeapShare{.t = 2, .heap = 1, .n_grains = 9, .volume = 2.5e-9});
  EXPECT_EQ(read_text(file), header + "1,-1,2,3,0\n2,0,1,9,2.5e-09\n");
  prepare_folder(folder.path(), 1.0);
  EXPECT_EQ(read_text(file), header + "1,-1,2,3,0\n");
  prepare_folder(folder.path(), {});
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(RunFolder, CutTableHandlesMissingEmptyAndForeignFiles) {
  const TemporaryFolder folder;
  const auto file = folder / "a.csv";
  const auto cut = [&](const char* text) {
    std::ofstream(file) << text;
    cut_table(file, "t,a", 1.0);
    return read_text(file);
  };
  cut_table(file, "t,a", 1.0);
  EXPECT_EQ(read_text(file), "t,a\n");
  EXPECT_EQ(cut(""), "t,a\n");
  EXPECT_EQ(cut("t,"), "t,a\n");  // killed while the header was written
  EXPECT_EQ(cut("t,a\n0,1\n1\nx,2\n0.5,3,4\n1,5\n2,6\n"), "t,a\n0,1\n1,5\n");
  EXPECT_THROW(cut("t,b\n1,2\n"), std::runtime_error);
  EXPECT_EQ(read_text(file), "t,b\n1,2\n");
}

TEST(RunFolder, ANewRunRemovesOnlyResultsAndARestartOnlyAFailure) {
  const TemporaryFolder folder;
  for (const char* name : {"fields.h5", "failure_grains.h5", "fields.xdmf", "restart_0000000100.h5",
                           "restart_0000000200.h5.tmp", "run.json", "log.txt", "notes.md",
                           "notes.tmp", "picture.png", "restart_mine.h5"}) {
    std::ofstream(folder / name) << "x";
  }
  prepare_folder(folder.path(), 1.0);
  EXPECT_EQ(files_in(folder.path()),
            (std::vector<std::string>{"columns.json", "dune.csv", "fields.h5", "fields.xdmf",
                                      "history.csv", "log.txt", "notes.md", "notes.tmp",
                                      "picture.png", "restart_0000000100.h5",
                                      "restart_0000000200.h5.tmp", "restart_mine.h5", "run.json"}));
  prepare_folder(folder.path(), {});
  EXPECT_EQ(files_in(folder.path()),
            (std::vector<std::string>{"columns.json", "dune.csv", "history.csv", "notes.md",
                                      "notes.tmp", "picture.png", "restart_mine.h5", "run.json"}));
  EXPECT_EQ(status_in(folder / "run.json"), "running");
}

TEST(RunFolder, ProblemsNameTheFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const auto text = message_of([&] { prepare_folder(folder / "file/run", {}); });
  EXPECT_NE(text.find("cannot make the folder " + (folder / "file/run").string()),
            std::string::npos)
      << text;
  const auto run = prepare_folder(folder / "run", {});
  const FileSizeLimit full(history_header.size() + 10);
  EXPECT_EQ(message_of([&] { append_record(run, history_record(0.5)); }),
            "cannot write " + (run / "history.csv").string() + ": File too large");
}

TEST(RunFolder, TheSummaryIsJsonWhateverItsNumbersAndTexts) {
  const TemporaryFolder folder;
  write_summary(folder.path(), {{"status", "done"},
                                {"title", "Quick \"start\""},
                                {"message", "bad bytes \xff in a path"},
                                {"phases", Phases{{"grains", 0.02}, {"pressure", 0.01}}},
                                {"max_cfl", std::nan("")}});
  const auto json = nlohmann::json::parse(read_text(folder / "run.json"));
  EXPECT_EQ(json.at("title"), "Quick \"start\"");
  EXPECT_EQ(json.at("phases").at("pressure"), 0.01);
  EXPECT_TRUE(json.at("max_cfl").is_null());
  EXPECT_EQ(status_in(folder / "run.json"), "done");
  std::ofstream(folder / "config.toml") << "[case]\n";
  EXPECT_EQ(status_in(folder / "config.toml"), "");
}

class OutFolder : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text = "mine\n") {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  std::string refused(const std::string& name) {
    return message_of([&] { check_out_folder(folder_ / name); });
  }
  std::string lost(const Config& config, const std::string& name) {
    return message_of([&] { check_nothing_is_lost(config, folder_ / name); });
  }
  TemporaryFolder folder_;
};

TEST_F(OutFolder, IsAFolderOrCanBecomeOne) {
  write("file");
  std::filesystem::create_directories(folder_ / "here/grains.h5");
  std::filesystem::create_symlink("nowhere", folder_ / "link");
  EXPECT_EQ(refused("new/and/deep"), "");
  EXPECT_EQ(refused("."), "");
  EXPECT_NE(refused("file").find("file is a file, not a folder; take another --out"),
            std::string::npos);
  EXPECT_NE(refused("file/run").find("file is a file, not a folder"), std::string::npos);
  EXPECT_NE(refused("link").find("a link that leads nowhere"), std::string::npos);
  EXPECT_NE(refused("here").find("grains.h5 in it is a folder"), std::string::npos);
  EXPECT_NE(refused(std::string(300, 'a')).find("too long"), std::string::npos);
  EXPECT_NE(message_of([] { check_out_folder({}); }).find("must name a folder"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

TEST_F(OutFolder, DoesNotHoldWhatTheCaseStartsFrom) {
  Config config = load_config_text(test::grain_case(), folder_ / "case.toml");
  EXPECT_EQ(lost(config, "out"), "");
  config.initial.grains = folder_ / "out/grains.h5";
  EXPECT_NE(lost(config, "out").find("it is in the run folder"), std::string::npos);
  EXPECT_EQ(lost(config, "other"), "");
  config.initial.grains = folder_ / "out/heap.csv";  // no result: it stays
  EXPECT_EQ(lost(config, "out"), "");
  config.initial.grains = folder_ / "elsewhere/out.toml";  // its results go to out as well
  EXPECT_NE(lost(config, "out").find("go to the folder of this one"), std::string::npos);
}

TEST_F(OutFolder, DoesNotHoldTheCaseItself) {
  const std::string text = test::grain_case();
  write("out/config.toml", text);
  const Config config = load_config_text(text, folder_ / "out/config.toml");
  EXPECT_NE(lost(config, "out").find("over this case"), std::string::npos);
  EXPECT_EQ(lost(config, "other"), "");
  write("out/config.toml", to_toml(config));  // the same again: a run repeated from its own words
  EXPECT_EQ(lost(config, "out"), "");
}

TEST_F(OutFolder, IsOfARunIfItHoldsResults) {
  const Config config = load_config_text(test::grain_case(), folder_ / "out/config.toml");
  const auto foreign = [&] { return message_of([&] { check_is_ours(config, folder_ / "out"); }); };
  EXPECT_EQ(foreign(), "");
  for (const char* name : {"notes.tmp", "thesis.txt", "config.toml", "restart_0000000100.h5",
                           "run.json.tmp"})  // the last one is all that a kill may leave
    write(std::string("out/") + name);
  EXPECT_EQ(foreign(), "");
  write("out/log.txt");
  EXPECT_NE(foreign().find("log.txt in it is not of a run; take another --out"), std::string::npos);
  write_summary(folder_ / "out", {{"status", "stopped"}});
  EXPECT_EQ(foreign(), "");
}

TEST_F(OutFolder, KeepsARunThatTookTime) {
  const Case the_case = load_case_text(test::grain_case(), folder_ / "case.toml");
  const Config& config = the_case.config;
  const auto kept = [&] {
    return message_of(
        [&] { check_overwrites_nothing(earlier_run(the_case, folder_ / "out"), folder_ / "out"); });
  };
  write("out/config.toml", to_toml(config));
  write_summary(folder_ / "out", {{"status", "failed"}});
  EXPECT_EQ(kept(), "");  // it had not come far enough for a restart file
  write("out/restart_0000000100.h5");
  EXPECT_NE(kept().find("holds an unfinished run: go on with --resume"), std::string::npos);
  write_summary(folder_ / "out", {{"status", "done"}});
  EXPECT_TRUE(earlier_run(the_case, folder_ / "out").done());
  write("out/config.toml", "[case]\n");
  EXPECT_NE(kept().find("holds a finished run of another configuration"), std::string::npos);
  EXPECT_FALSE(earlier_run(the_case, folder_ / "out").done());
}

/// Inputs count by their content; one of a case also by that of what it starts from.
TEST_F(OutFolder, IsOfOtherResultsWhenAnInputHasChanged) {
  write("heap.csv", "id,diameter,x,y,z\n1,2e-4,0,0,0\n");
  const auto text = [](const std::string& start) {
    return "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[grains]\n[initial]\ngrains = "
           "\"" +
           start + "\"\n";
  };
  write("heap.toml", text("heap.csv"));
  const Case the_case = load_case_text(text("heap.toml"), folder_ / "case.toml");
  const auto changed = [&](const nlohmann::json& recorded) {
    const auto file = changed_input(recorded, the_case);
    return file ? file->filename().string() : "";
  };
  nlohmann::json recorded;
  EXPECT_EQ(changed(recorded), "") << "nothing is known";
  recorded["initial.grains"] = {{"config", to_toml(the_case.grain_start->config)},
                                {"initial.grains", content_key(folder_ / "heap.csv")}};
  EXPECT_EQ(changed(recorded), "");
  EXPECT_EQ(changed({{"initial.grains", {{"config", "[case]\n"}}}}), "heap.toml");
  EXPECT_EQ(changed(nlohmann::json::object()), "heap.toml") << "it began from something else";
  EXPECT_EQ(changed("damaged"), "heap.toml");

  write("out/config.toml", to_toml(the_case.config));
  write("out/config.inputs.json", recorded.dump());
  write("out/restart_0000000100.h5");
  write_summary(folder_ / "out", {{"status", "done"}});
  EXPECT_TRUE(earlier_run(the_case, folder_ / "out").done());
  write("heap.csv", "id,diameter,x,y,z\n1,2e-4,0,1,0\n");  // of the same length
  EXPECT_EQ(changed(recorded), "heap.csv");
  const EarlierRun other = earlier_run(the_case, folder_ / "out");
  EXPECT_FALSE(other.done());
  EXPECT_EQ(other.difference(), "from another content of " + (folder_ / "heap.csv").string());
}

TEST_F(OutFolder, HoldsTablesAndFramesThatARestartGoesOnWith) {
  const auto refused_to_go_on = [&] {
    return message_of([&] { check_results_go_on(folder_.path()); });
  };
  EXPECT_EQ(refused_to_go_on(), "");
  write("dune.csv", "t,other\n");
  EXPECT_NE(refused_to_go_on().find("its columns are not"), std::string::npos);
  std::filesystem::remove(folder_ / "dune.csv");
  write("grains.h5");
  EXPECT_NE(refused_to_go_on().find("it is not an HDF5 file"), std::string::npos);
}

}  // namespace
}  // namespace barchan
