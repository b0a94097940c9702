#include "src/app/info.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "src/app/info_path.hpp"
#include "src/base/atomic_file.hpp"
#include "src/io/frame_file.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/history_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const Provenance origin{.title = "Ten thousand grains",
                        .config = "[case]\n",
                        .version = "1.2.3",
                        .git_hash = "abc1234",
                        .backend = "OpenMP"};

TEST(Info, DescribesResults) {
  const TemporaryFolder folder;
  FrameFile file(folder / "grains.h5", origin, {}, MPI_COMM_SELF);
  const std::vector<double> x(30);
  for (int k = 0; k < 3; ++k) {
    file.append(
        0.1 * k, 400 * k, [](Hdf5File&) {},
        [&x](Hdf5File& h, const std::string& group) {
          h.write(group + "/x", std::span<const double>(x), {10, 3}, "m");
        });
  }
  const std::string text = describe_file(folder / "grains.h5");
  for (const char* part :
       {"Ten thousand grains", "barchan 1.2.3 (abc1234), OpenMP",
        "3: frame_000000 ... frame_000002", "0.2 s (step 800)", "10 x 3", "[m]"}) {
    EXPECT_TRUE(contains(text, part)) << text;
  }
}

TEST(Info, DescribesRestarts) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder.path(), 1200, origin);
  writer.scalar("t", 0.3);
  const std::vector<double> p(24);
  writer.array("fluid/p", std::span<const double>(p), {2, 3, 4});
  const std::string text = describe_file(writer.commit(1));
  for (const char* part : {"restart file of step 1200", "0.3 s", "fluid/p", "2 x 3 x 4"}) {
    EXPECT_TRUE(contains(text, part)) << text;
  }
}

TEST(Info, OtherFilesAreBadInput) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text.h5") << "text\n";
  { Hdf5File(folder / "foreign.h5", Hdf5File::Mode::create).close(); }
  const auto refusal = [&](const char* name) {
    return message_of([&] { describe_file(folder / name, {}); });  // nobody writes them
  };
  EXPECT_TRUE(contains(refusal("text.h5"), "not an HDF5 file")) << refusal("text.h5");
  EXPECT_TRUE(contains(refusal("foreign.h5"), "not one that barchan wrote"));
  EXPECT_NE(refusal("."), "");
  EXPECT_EQ(refusal("no.h5"),
            "cannot read " + (folder / "no.h5").string() + ": No such file or directory");
}

TEST(Info, FoldersOfRunsAndStudies) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "one");
  std::ofstream(folder / "one/run.json")
      << R"({"status": "failed", "message": "disk full", "title": "Ten", "version": "0.1.0",
             "git_hash": "abc", "device": "OpenMP, 2 threads", "steps": 40, "simulated_seconds": 0.5,
             "wall_seconds": 12.0, "max_cfl": 0.25, "max_overlap": 0.0125, "grains_initial": 10,
             "grains_left": 3})";
  std::ofstream(folder / "one/grains.h5") << "12345";
  std::ofstream(folder / "one/mine.txt") << "mine";
  const std::string run = describe_path(folder / "one");
  for (const char* part : {"run folder", "failed: disk full", "Ten", "0.1.0 (abc), OpenMP, 2",
                           "0.5 s, step 40", "10 at first, 3 left", "0.25", "0.0125", "grains.h5"})
    EXPECT_TRUE(contains(run, part)) << part << " in " << run;
  EXPECT_FALSE(contains(run, "mine.txt"));
  EXPECT_EQ(describe_path(folder / "one/run.json"), run);
  std::ofstream(folder / "study.json")
      << R"({"title": "Sizes", "base": "a.toml", "cases": [{"folder": "one"}, {"folder": "two"}]})";
  const std::string study = describe_path(folder.path());
  for (const char* part : {"study folder", "Sizes", "a.toml", "cases    2"})
    EXPECT_TRUE(contains(study, part)) << study;
  EXPECT_NE(study.find("failed", study.find("  one")), std::string::npos) << study;
  EXPECT_NE(study.find("waiting", study.find("  two")), std::string::npos) << study;
}

TEST(Info, TablesAndCases) {
  const TemporaryFolder folder;
  std::ofstream(folder / "history.csv") << kHistoryTable.header() << "\n0,0\n0.25,100\n";
  const std::string history = describe_path(folder / "history.csv");
  for (const char* part :
       {"rows     2, t = 0 ... 0.25 s", "[m/s]", "u_star", "over the longest stable one"})
    EXPECT_TRUE(contains(history, part)) << history;
  std::ofstream(folder / "heap.csv") << "id,diameter,x,y,z\n1,2e-4,0,0,0\n2,3e-4,1,1,1\n";
  EXPECT_TRUE(contains(describe_path(folder / "heap.csv"), "2\ndiameter 0.0002 ... 0.0003 m"));
  std::ofstream(folder / "other.csv") << "a,b\n1,2\n";
  EXPECT_TRUE(contains(describe_path(folder / "other.csv"), "columns  a,b"));
  const std::string quick = describe_path(BARCHAN_SOURCE_DIR "/configs/quickstart.toml");
  for (const char* part : {"kind     case", "0.045 x 0.0125 x 0.02 m", "44 x 36 x 20", "1.2 s"})
    EXPECT_TRUE(contains(quick, part)) << quick;
}

TEST(Info, WhatIsNeitherIsToldAsSuch) {
  const TemporaryFolder folder;
  std::ofstream(folder / "picture.png") << "x";
  std::ofstream(folder / "empty.csv");
  std::ofstream(folder / "grains.h5") << "x";
  std::filesystem::create_directories(folder / "broken");
  std::ofstream(folder / "broken/run.json") << "{";
  const auto refusal = [&](const char* name) {
    return message_of([&] { describe_path(folder / name); });
  };
  EXPECT_TRUE(contains(refusal("picture.png"), "info knows run and study folders"));
  EXPECT_TRUE(contains(refusal("empty.csv"), "is empty"));
  EXPECT_TRUE(contains(refusal("broken"), "damaged"));
  EXPECT_TRUE(contains(refusal("."), "neither a run nor a study"));
  EXPECT_TRUE(contains(refusal("grain.h5"), "did you mean " + (folder / "grains.h5").string()));
}

TEST(Info, WaitsForARunThatIsWriting) {
  using namespace std::chrono_literals;
  const TemporaryFolder folder;
  const auto path = folder / "grains.h5";
  FrameFile(path, origin, {}, MPI_COMM_SELF)
      .append(0, 0, {}, [](Hdf5File& h, const std::string& group) {
        const std::vector<double> x(3000);
        h.write(group + "/x", std::span<const double>(x), {1000, 3}, "m");
      });
  const std::string whole = read_text(path);
  const auto write = [&](std::size_t n) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, n);
  };
  write(whole.size() / 2);
  EXPECT_TRUE(contains(message_of([&] { describe_file(path, {}); }), "or is writing it"));
  std::thread run([&] {
    std::this_thread::sleep_for(100ms);
    write(whole.size());
  });
  EXPECT_TRUE(contains(describe_file(path, 60s), "1: frame_000000"));
  run.join();
  // Nobody is at work on a file that is older: this does not wait.
  write(whole.size() / 2);
  std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() - 1h);
  EXPECT_TRUE(contains(message_of([&] { describe_file(path, 24h); }), "cut short"));
}

}  // namespace
}  // namespace barchan
