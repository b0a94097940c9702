#include "src/base/words.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "src/base/atomic_file.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

namespace fs = std::filesystem;

// The launcher and Python are held to the same table, by script.launched and test_program.py.
TEST(Words, ACaseIsCalledAsItsFileWithoutTheLastEnding) {
  std::ifstream in(test::reference_file("run_names.csv"));
  int count = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    const std::string file = line.substr(0, line.find(','));
    const std::string name = line.substr(line.find(',') + 1);
    for (const std::string folder : {"", "some.where/", "/", "./configs/../"})
      EXPECT_EQ(case_name(folder + file), name) << folder + file;
    ++count;
  }
  EXPECT_GT(count, 10);
}

TEST(Words, AFileThatIsNotThereIsNotMeant) {
  const TemporaryFolder folder;
  const fs::path loop = folder / "start.h5", other = folder / "stars.h5";
  fs::create_symlink("start.h5", loop);
  EXPECT_EQ(not_a_file(loop), "it is a link that leads nowhere");
  EXPECT_EQ(nearest_file(loop), "");
  write_atomically(other, "");
  EXPECT_EQ(nearest_file(loop), " (did you mean " + other.string() + "?)");
  EXPECT_EQ(not_a_file(folder / "absent"), "No such file or directory");
  write_atomically(folder / "dune.toml", "");
  EXPECT_EQ(nearest_file(folder / "dune"),
            " (did you mean " + (folder / "dune.toml").string() + "?)");
}

TEST(Words, ALineIsNotAddedThroughALink) {
  const TemporaryFolder folder;
  write_atomically(folder / "precious", "text");
  fs::create_symlink("precious", folder / "history.csv");
  EXPECT_THROW(append_text(folder / "history.csv", "line\n"), std::runtime_error);
  EXPECT_EQ(read_text(folder / "precious"), "text");
}

}  // namespace
}  // namespace barchan
