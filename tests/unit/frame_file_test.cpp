#include "src/io/frame_file.hpp"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {
// Number of writes until the process is killed; negative: never.
long writes_left = -1;
}  // namespace

/// Takes the place of the C library's pwrite in this executable, so that a test can stop a process
/// at any write to a result file.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): theirs are reserved
extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  if (writes_left == 0) _exit(9);
  if (writes_left > 0) --writes_left;
  return syscall(SYS_pwrite64, descriptor, bytes, size, offset);
}

namespace barchan {
namespace {

constexpr std::uint64_t rows = 500;

/// Every value of frame k is k, at t = k.
void append(FrameFile& file, int k) {
  const std::vector<double> x(rows * 3, k);
  file.append(
      k, 10 * k,
      [](Hdf5File& h) {
        const std::vector<double> faces{0, 1, 2};
        h.write("grid/x_face", std::span<const double>(faces), {3}, "m");
      },
      [&x](Hdf5File& h, const std::string& group) {
        h.write(group + "/x", std::span<const double>(x), {rows, 3}, "m");
        h.write(group + "/u", std::span<const double>(x), {rows, 3}, "m/s");
      });
}

FrameFile open(const std::filesystem::path& path, std::optional<double> restart_time) {
  return {path, {.title = "frames"}, restart_time, MPI_COMM_SELF};
}

/// Times of the frames in a file whose values all are what append() wrote.
std::vector<double> sound_times(const std::filesystem::path& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  std::vector<double> times;
  for (const auto& frame : list_frames(file)) {
    EXPECT_EQ(frame.step, std::int64_t(10 * frame.t));
    for (const std::string name : {"x", "u"}) {
      for (const double value : file.read<double>(frame.name + "/" + name)) {
        if (value != frame.t) return {};
      }
    }
    times.push_back(frame.t);
  }
  return times;
}

TEST(FrameFile, AppendsAndLists) {
  const TemporaryFolder folder;
  FrameFile file = open(folder / "a.h5", {});
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
  for (int k = 0; k < 12; ++k) append(file, k);
  EXPECT_EQ(sound_times(folder / "a.h5").size(), 12u);
  EXPECT_EQ(file.frames().size(), 12u);
  EXPECT_EQ(file.frames()[11].name, "frame_000011");
  EXPECT_EQ(file.frames()[11].arrays.size(), 2u);
  const Hdf5File opened(folder / "a.h5", Hdf5File::Mode::read);
  EXPECT_TRUE(opened.exists("grid/x_face"));
  EXPECT_EQ(read_provenance(opened).title, "frames");
}

TEST(FrameFile, ANewRunReplacesTheFile) {
  const TemporaryFolder folder;
  {
    FrameFile file = open(folder / "a.h5", {});
    for (int k = 0; k < 3; ++k) append(file, k);
  }
  FrameFile file = open(folder / "a.h5", {});
  append(file, 7);
  EXPECT_EQ(sound_times(folder / "a.h5"), std::vector<double>{7});
}

TEST(FrameFile, ARestartDropsLaterFramesOfShortSteps) {
  const TemporaryFolder folder;
  constexpr double step = 1e-10;
  {
    FrameFile file = open(folder / "a.h5", {});
    for (int k = 0; k < 6; ++k) file.append(k * step, k, {}, [](Hdf5File&, const std::string&) {});
  }
  const FrameFile file = open(folder / "a.h5", 3 * step);
  ASSERT_EQ(file.frames().size(), 4u);
  EXPECT_EQ(file.frames().back().step, 3);
}

TEST(FrameFile, ARestartDropsLaterFramesAndNumbersOn) {
  const TemporaryFolder folder;
  {
    FrameFile file = open(folder / "a.h5", {});
    for (int k = 0; k < 6; ++k) append(file, k);
  }
  FrameFile file = open(folder / "a.h5", 3.0);
  EXPECT_EQ(sound_times(folder / "a.h5"), (std::vector<double>{0, 1, 2, 3}));
  append(file, 4);
  EXPECT_EQ(file.frames().back().name, "frame_000004");
  EXPECT_EQ(sound_times(folder / "a.h5"), (std::vector<double>{0, 1, 2, 3, 4}));
  // All frames dropped, and a restart without a file.
  FrameFile none = open(folder / "a.h5", -1.0);
  EXPECT_TRUE(none.frames().empty());
  append(none, 5);
  EXPECT_EQ(sound_times(folder / "a.h5"), std::vector<double>{5});
  FrameFile fresh = open(folder / "b.h5", 3.0);
  append(fresh, 4);
  EXPECT_EQ(fresh.frames().back().name, "frame_000000");
}

/// Makes a file of `before` frames, runs `act` in a process that is killed at its n-th write, for
/// every n, and looks at the file after each.
void kill_at_every_write(int before, const std::function<void(const std::filesystem::path&)>& act,
                         const std::function<void(const std::vector<double>&)>& look) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  int status = 9, writes = 0;
  for (; status == 9; ++writes) {
    SCOPED_TRACE("killed at write " + std::to_string(writes));
    std::filesystem::remove(path);
    {
      FrameFile file = open(path, {});
      for (int k = 0; k < before; ++k) append(file, k);
    }
    const pid_t child = fork();
    if (child == 0) {
      writes_left = writes;
      act(path);
      _exit(0);
    }
    waitpid(child, &status, 0);
    status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;

    const auto times = sound_times(path);
    look(times);
    FrameFile file = open(path, 1e9);  // and the run can go on
    append(file, 9);
    ASSERT_EQ(sound_times(path).size(), times.size() + 1);
  }
  EXPECT_EQ(status, 0);
  EXPECT_GT(writes, 1);
}

TEST(FrameFile, AKillAtAnyWriteKeepsTheEarlierFrames) {
  kill_at_every_write(
      3,
      [](const std::filesystem::path& path) {
        FrameFile file = open(path, 1e9);
        append(file, 3);
      },
      [](const std::vector<double>& times) { ASSERT_GE(times.size(), 3u); });
}

TEST(FrameFile, AKillWhileFramesAreDroppedKeepsTheOthers) {
  kill_at_every_write(
      5, [](const std::filesystem::path& path) { open(path, 1.0); },
      [](const std::vector<double>& times) {
        ASSERT_GE(times.size(), 2u);
        EXPECT_EQ(times[1], 1.0);
      });
}

TEST(FrameFile, AFullDiskKeepsTheEarlierFrames) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  FrameFile file = open(path, {});
  for (int k = 0; k < 3; ++k) append(file, k);
  {
    const FileSizeLimit full(std::filesystem::file_size(path) + 4096);
    EXPECT_THROW(append(file, 3), Hdf5Error);
    EXPECT_THROW(append(file, 3), Hdf5Error);
  }
  EXPECT_EQ(sound_times(path), (std::vector<double>{0, 1, 2}));
  append(file, 3);
  EXPECT_EQ(sound_times(path), (std::vector<double>{0, 1, 2, 3}));
  {
    const FileSizeLimit full(4096);
    FrameFile other = open(folder / "b.h5", {});
    EXPECT_THROW(append(other, 0), Hdf5Error);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "b.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.tmp"));
}

TEST(FrameFile, AReaderDoesNotStopTheRun) {
  const TemporaryFolder folder;
  FrameFile file = open(folder / "a.h5", {});
  append(file, 0);
  // Another process holds the file open, as a viewer does.
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const Hdf5File reader(folder / "a.h5", Hdf5File::Mode::read);
    if (::write(ready[1], "r", 1) == 1) pause();
    _exit(1);
  }
  close(ready[1]);
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_NO_THROW(append(file, 1));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(ready[0]);
}

}  // namespace
}  // namespace barchan
