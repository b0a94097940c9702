#include "src/io/frame_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <set>

#include "src/base/atomic_file.hpp"
#include "src/io/hdf5_handle.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {
/// Fault during a write: the process is killed before it, or within it; the disk is full from then
/// on.
enum class Fault { kill, kill_within, full_disk };
Fault fault = Fault::kill;
long writes_left = -1;  // until then; negative: it does not come
}  // namespace

/// Takes the place of the C library's pwrite in this executable, so that a test can stop a process
/// at any write to a result file.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): theirs are reserved
extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  const bool now = writes_left == 0, later = fault == Fault::full_disk && writes_left < -1;
  if (writes_left >= 0 || later) --writes_left;
  if (now && fault == Fault::kill) _exit(9);
  if (later) {
    errno = ENOSPC;
    return -1;
  }
  // A word within a page is written or not; of more than that any part may be.
  const bool torn = now && size > 8;
  const ssize_t done = syscall(SYS_pwrite64, descriptor, bytes, torn ? size / 2 : size, offset);
  if (now && fault == Fault::kill_within) _exit(9);
  if (now) writes_left = -2;
  return done;
}

namespace barchan {
namespace {

/// Every value of frame k is k, at t = k.
void append(FrameFile& file, int k, std::uint64_t rows = 500) {
  const std::vector<double> x(rows * 3, k);
  file.append(
      k, 10 * k,
      [](Hdf5File& h) {
        const std::vector<double> faces{0, 1, 2};
        h.write("grid/x_face", std::span<const double>(faces), {3}, "m");
      },
      [&x, rows](Hdf5File& h, const std::string& group) {
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

/// A file of n small frames.
void make_frames(const std::filesystem::path& path, int n) {
  FrameFile file = open(path, {});
  for (int k = 0; k < n; ++k) append(file, k, 1);
}

/// Copies a file and runs `act` on the copy, in a process that meets a fault at its n-th write, for
/// every n; looks at the copy after each.
void meet_at_every_write(Fault what, const std::filesystem::path& made,
                         const std::function<void(const std::filesystem::path&)>& act,
                         const std::function<void(const std::filesystem::path&)>& look) {
  const auto path = std::filesystem::path(made).replace_extension(".copy.h5");
  int status = -1, writes = 0;
  for (; status != 0; ++writes) {
    SCOPED_TRACE("at write " + std::to_string(writes));
    std::filesystem::copy_file(made, path, std::filesystem::copy_options::overwrite_existing);
    const pid_t child = fork();
    if (child == 0) {
      fault = what;
      writes_left = writes;
      try {
        act(path);
      } catch (const Hdf5Error&) {
        _exit(1);
      }
      _exit(writes_left >= 0 ? 0 : 1);
    }
    waitpid(child, &status, 0);
    status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ASSERT_TRUE(status == 0 || status == (what == Fault::full_disk ? 1 : 9)) << status;
    look(path);
  }
  EXPECT_GT(writes, 10);
}

/// Paths of the frames of a file.
std::vector<std::string> names_in(const Hdf5File& file, const std::string& group = "") {
  std::vector<std::string> names;
  for (const auto& name : file.children(group.empty() ? "/" : group)) {
    if (name == "grid") continue;
    if (!name.starts_with("frame_group_")) {
      names.push_back(group.empty() ? name : group + "/" + name);
      continue;
    }
    const auto more = names_in(file, name);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

/// Test of one more frame, behind so many.
class FrameFileOf : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Frames, FrameFileOf, testing::Values(10, 249, 250));
INSTANTIATE_TEST_SUITE_P(NightlyFrames, FrameFileOf, testing::Values(1, 500, 2046, 2250, 5000));

TEST_P(FrameFileOf, KeepsThemWhateverTheNextWriteMeets) {
  const int n = GetParam();
  const TemporaryFolder folder;
  make_frames(folder / "a.h5", n);
  const std::string before = read_text(folder / "a.h5");
  const auto names = names_in(Hdf5File(folder / "a.h5", Hdf5File::Mode::read));
  ASSERT_EQ(names.size(), std::size_t(n));
  const auto look = [&](const std::filesystem::path& path) {
    {  // All names are there, and what they lead to is what it was.
      const Hdf5File file(path, Hdf5File::Mode::read);
      const auto now = names_in(file);
      const std::set<std::string> all(now.begin(), now.end());
      ASSERT_TRUE(now.size() == names.size() || now.size() == names.size() + 1);
      for (const auto& name : names) ASSERT_TRUE(all.contains(name)) << name;
      for (const auto& name : {now.front(), now.back()}) {
        const auto t = file.attribute<double>(name, "time");
        ASSERT_EQ(file.read<double>(name + "/u"), std::vector<double>(3, t));
      }
    }
    const std::string after = read_text(path);
    ASSERT_GE(after.size(), before.size());
    int words = 0;
    for (std::size_t k = 0; k + 8 <= before.size(); k += 8)
      words += std::memcmp(before.data() + k, after.data() + k, 8) == 0 ? 0 : 1;
    ASSERT_LE(words, 16);
    if (n > 10) return;
    const auto times = sound_times(path);
    FrameFile file = open(path, 1e9);  // and the run can go on
    append(file, 9999, 1);
    ASSERT_EQ(sound_times(path).size(), times.size() + 1);
  };
  for (const Fault what : {Fault::kill, Fault::kill_within, Fault::full_disk}) {
    SCOPED_TRACE("fault " + std::to_string(static_cast<int>(what)));
    std::filesystem::copy_file(folder / "a.h5", folder / "a.copy.h5",
                               std::filesystem::copy_options::overwrite_existing);
    FrameFile file = open(folder / "a.copy.h5", 1e9);
    meet_at_every_write(
        what, folder / "a.h5", [&](const std::filesystem::path&) { append(file, n, 1); }, look);
  }
}

TEST(FrameFile, AKillWhileFramesAreDroppedKeepsTheOthers) {
  const TemporaryFolder folder;
  make_frames(folder / "a.h5", 5);
  meet_at_every_write(
      Fault::kill, folder / "a.h5", [](const std::filesystem::path& path) { open(path, 1.0); },
      [](const std::filesystem::path& path) {
        const auto times = sound_times(path);
        ASSERT_GE(times.size(), 2u);
        EXPECT_EQ(times[1], 1.0);
        FrameFile file = open(path, 1e9);  // and the run can go on
        append(file, 9, 1);
        ASSERT_EQ(sound_times(path).size(), times.size() + 1);
      });
}

/// Makes a file as version 0.2.0 wrote it: frames in the old kind of table, which grows in place.
void make_old_file(const std::filesystem::path& path, int n) {
  using hdf5::Handle;
  Hdf5File(path, Hdf5File::Mode::create).close();  // starts the library
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  const hsize_t extents[] = {1, 3};
  const Handle rows(H5Screate_simple(2, extents, nullptr), H5Sclose);
  for (int k = 0; k < n; ++k) {
    const std::string name = fmt::format("frame_{:06}", k);
    const Handle group(H5Gcreate2(file.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    const double t = k, values[] = {t, t, t};
    const std::int64_t step = 10 * k;
    const Handle time(
        H5Acreate2(group.get(), "time", H5T_NATIVE_DOUBLE, scalar.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    H5Awrite(time.get(), H5T_NATIVE_DOUBLE, &t);
    const Handle number(
        H5Acreate2(group.get(), "step", H5T_NATIVE_INT64, scalar.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    H5Awrite(number.get(), H5T_NATIVE_INT64, &step);
    for (const char* array : {"x", "u"}) {
      const Handle data(H5Dcreate2(group.get(), array, H5T_NATIVE_DOUBLE, rows.get(), H5P_DEFAULT,
                                   H5P_DEFAULT, H5P_DEFAULT),
                        H5Dclose);
      H5Dwrite(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    }
  }
}

TEST(FrameFile, GoesOnWithAFileOfAnEarlierVersion) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  make_old_file(path, 253);
  EXPECT_FALSE(Hdf5File(path, Hdf5File::Mode::read).has_room());
  EXPECT_EQ(sound_times(path).size(), 253u);
  FrameFile file = open(path, 1e9);
  append(file, 253);
  EXPECT_TRUE(Hdf5File(path, Hdf5File::Mode::read).has_room());
  EXPECT_EQ(sound_times(path).size(), 254u);
  EXPECT_EQ(file.frames()[249].name, "frame_000249");
  EXPECT_EQ(file.frames()[252].name, "frame_group_001/frame_000252");
  EXPECT_EQ(open(path, 251.0).frames().size(), 252u);

  make_old_file(folder / "b.h5", 3);
  meet_at_every_write(
      Fault::kill, folder / "b.h5", [](const std::filesystem::path& copy) { open(copy, 1e9); },
      [](const std::filesystem::path& copy) { ASSERT_EQ(sound_times(copy).size(), 3u); });
}

/// The root is filled to the last name, with attributes as a run writes them: its header has not
/// grown, which a kill would not survive.
TEST(FrameFile, ARootNeverGrows) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  const std::string text(100000, 'x');
  {
    Hdf5File file(path, Hdf5File::Mode::create);
    write_provenance(file, {text, text, text, text, text});
    file.make_group("grid");
  }
  const auto growth = [&path](const std::string& name) {
    const auto before = std::filesystem::file_size(path);
    Hdf5File file(path, Hdf5File::Mode::modify);
    file.begin_hidden_group(name);
    file.publish_group();
    return std::filesystem::file_size(path) - before;
  };
  const auto frame = growth("frame_000000"), group = growth("frame_group_001/frame_000250");
  for (int k = 1; k < 250; ++k) ASSERT_EQ(growth(fmt::format("frame_{:06}", k)), frame);
  for (int k = 251; k < 500; ++k)
    ASSERT_EQ(growth(fmt::format("frame_group_001/frame_{:06}", k)), frame);
  for (int k = 2; k < 1000; ++k)
    ASSERT_EQ(growth(fmt::format("frame_group_{:03}/frame_{:06}", k, 250 * k)), group) << k;
  EXPECT_GT(growth(std::string(9000, 'n')), frame + 9000);  // it would be seen
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
  const auto before = std::filesystem::file_size(path);
  for (std::uintmax_t room = 0; file.frames().size() == 3; room += 100) {
    ASSERT_LT(room, 100000u);
    ASSERT_EQ(sound_times(path), (std::vector<double>{0, 1, 2}));
    const FileSizeLimit full(before + room);
    try {
      append(file, 3);
    } catch (const Hdf5Error&) {
    }
  }
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
