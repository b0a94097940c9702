#include "src/run/commands.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "src/io/checkpoint.hpp"
#include "src/io/frame_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const Provenance origin{.title = "Ten thousand grains",
                        .config = "[case]\n",
                        .version = "0.1.0",
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
       {"Ten thousand grains", "barchan 0.1.0 (abc1234), OpenMP",
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
    return message_of([&] { describe_file(folder / name); });
  };
  EXPECT_TRUE(contains(refusal("text.h5"), "not an HDF5 file")) << refusal("text.h5");
  EXPECT_TRUE(contains(refusal("foreign.h5"), "not one that barchan wrote"));
  EXPECT_NE(refusal("."), "");
  EXPECT_EQ(refusal("no.h5"),
            "cannot read " + (folder / "no.h5").string() + ": No such file or directory");
}

}  // namespace
}  // namespace barchan
