#include "src/io/folder_lock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "src/base/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

namespace fs = std::filesystem;

TEST(FolderLock, IsForOneAtATimeAndSaysWho) {
  const TemporaryFolder folder;
  auto first = FolderLock::take(folder.path());
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->enforced());
  EXPECT_FALSE(FolderLock::take(folder.path()));
  EXPECT_NE(FolderLock::holder_of(folder.path()).find(fmt::format("process {} on ", ::getpid())),
            std::string::npos);
  first.reset();
  EXPECT_TRUE(FolderLock::take(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, RemovesOnlyAFolderThatItMadeAndNobodyUsed) {
  const TemporaryFolder folder;
  ASSERT_TRUE(FolderLock::take(folder / "new/deep"));
  EXPECT_FALSE(fs::exists(folder / "new"));
  {
    const auto lock = FolderLock::take(folder / "used");
    std::ofstream(folder / "used/result") << "x";
  }
  EXPECT_TRUE(fs::exists(folder / "used/result"));
  fs::create_directory(folder / "mine");
  ASSERT_TRUE(FolderLock::take(folder / "mine"));
  EXPECT_TRUE(fs::exists(folder / "mine"));
}

TEST(FolderLock, EndsWithItsProcess) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const auto lock = FolderLock::take(folder.path());
    ::raise(SIGKILL);
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ASSERT_TRUE(fs::exists(FolderLock::file_in(folder.path())));
  EXPECT_TRUE(FolderLock::take(folder.path()));
}

/// Whoever finds the file of a lock that ends just then must not be left with one nobody else sees.
TEST(FolderLock, IsNotThatOfAFileThatIsGone) {
  const TemporaryFolder folder;
  auto first = FolderLock::take(folder / "run");
  fs::rename(folder / "run", folder / "aside");  // with the lock in it
  const auto second = FolderLock::take(folder / "run");
  ASSERT_TRUE(second);
  first.reset();
  EXPECT_FALSE(FolderLock::take(folder / "run")) << "the first one removed the second one's file";
}

TEST(FolderLock, SaysWhyAFolderCannotBeUsed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(FolderLock::take(folder / "file/run"), InputError);
  fs::create_symlink(folder / "victim", FolderLock::file_in(folder.path()));
  EXPECT_THROW(FolderLock::take(folder.path()), InputError) << "a link was followed";
  EXPECT_FALSE(fs::exists(folder / "victim"));
}

}  // namespace
}  // namespace barchan
