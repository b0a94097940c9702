#include "src/app/info.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "src/base/atomic_file.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/frame_file.hpp"
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
