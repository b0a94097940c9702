#include "src/io/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>

#include "src/base/atomic_file.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using Mode = Hdf5File::Mode;

template <class T>
std::vector<T> counting(std::size_t n) {
  std::vector<T> values(n);
  std::iota(values.begin(), values.end(), T{1});
  return values;
}

template <class T>
void write(Hdf5File& file, const std::string& name, const std::vector<T>& values,
           const Extents& extents) {
  file.write(name, std::span<const T>(values), extents, "m/s");
}

TEST(Hdf5File, ArraysOfAllRanksAndTypesComeBack) {
  const TemporaryFolder folder;
  const auto a = counting<double>(5), b = counting<double>(2 * 3 * 4);
  const auto c = counting<float>(6);
  const auto d = counting<std::int64_t>(7);
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    write(file, "a", a, {5});
    write(file, "group/deep/b", b, {2, 3, 4});
    write(file, "c", c, {2, 3});
    write(file, "d", d, {7});
    write(file, "empty", std::vector<double>{}, {0, 3});
    file.close();
  }
  const Hdf5File file(folder / "a.h5", Mode::read);
  EXPECT_EQ(file.read<double>("a"), a);
  EXPECT_EQ(file.read<double>("group/deep/b", {2, 3, 4}), b);
  EXPECT_EQ(file.read<float>("c"), c);
  EXPECT_EQ(file.read<double>("c"), counting<double>(6));  // widened
  EXPECT_EQ(file.read<std::int64_t>("d"), d);
  EXPECT_TRUE(file.read<double>("empty").empty());
  EXPECT_EQ(file.info("empty").extents, (Extents{0, 3}));
  EXPECT_EQ(file.info("c").type, ElementType::float32);
  EXPECT_EQ(file.info("d").type, ElementType::int64);
  EXPECT_EQ(file.attribute<std::string>("group/deep/b", "units"), "m/s");
  EXPECT_EQ(file.children(), (std::vector<std::string>{"a", "c", "d", "empty", "group"}));
  EXPECT_TRUE(file.is_group("group/deep"));
  EXPECT_FALSE(file.is_group("a"));
}

TEST(Hdf5File, KeepsEveryBit) {
  const TemporaryFolder folder;
  const std::vector<double> odd{-0.0, std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::infinity(), std::nextafter(1.0, 2.0)};
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    write(file, "odd", odd, {4});
  }
  const auto back = Hdf5File(folder / "a.h5", Mode::read).read<double>("odd");
  ASSERT_EQ(back.size(), odd.size());
  EXPECT_EQ(std::memcmp(back.data(), odd.data(), odd.size() * sizeof(double)), 0);
}

TEST(Hdf5File, AttributesComeBackAndAreReplaced) {
  const TemporaryFolder folder;
  Hdf5File file(folder / "a.h5", Mode::create);
  file.set_attribute("/", "x", 0.1);
  file.set_attribute("/", "n", std::int64_t{1} << 60);
  file.set_attribute("/", "text", "first");
  file.set_attribute("/", "text", "[case]\ntitle = \"d\u00fcne\"\n");
  file.set_attribute("/", "nothing", "");
  EXPECT_EQ(file.attribute<double>("/", "x"), 0.1);
  EXPECT_EQ(file.attribute<std::int64_t>("/", "n"), std::int64_t{1} << 60);
  EXPECT_EQ(file.attribute<std::string>("/", "text"), "[case]\ntitle = \"d\u00fcne\"\n");
  EXPECT_EQ(file.attribute<std::string>("/", "nothing"), "");
  EXPECT_FALSE(file.has_attribute("/", "other"));
  EXPECT_THROW(file.attribute<double>("/", "n"), Hdf5Error);
  EXPECT_THROW(file.attribute<std::string>("/", "other"), Hdf5Error);
}

TEST(Hdf5File, ALinkInTheWayOfANewFileIsNotFollowed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "victim") << "of others";
  std::filesystem::create_symlink("victim", folder / "a.h5");
  Hdf5File(folder / "a.h5", Mode::create).close();
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "a.h5"));
  EXPECT_EQ(std::filesystem::file_size(folder / "victim"), 9u);
  EXPECT_NO_THROW(Hdf5File(folder / "a.h5", Mode::create).close());  // nor is a file of ours
}

TEST(Hdf5File, ProblemsAreSentences) {
  const TemporaryFolder folder;
  const auto open = [](const std::filesystem::path& path) {
    return message_of([&path] { Hdf5File(path, Mode::read); });
  };
  const std::string missing = (folder / "missing.h5").string();
  EXPECT_EQ(open(missing), "cannot read " + missing + ": No such file or directory");
  EXPECT_EQ(open(folder.path()), "cannot read " + folder.path().string() + ": it is a folder");
  std::ofstream(folder / "text.h5") << "not a data file, but long enough to be looked at\n";
  EXPECT_EQ(open(folder / "text.h5"),
            "cannot read " + (folder / "text.h5").string() + ": it is not an HDF5 file");
  std::ofstream(folder / "empty.h5").close();
  EXPECT_NE(open(folder / "empty.h5"), "");
  {
    Hdf5File file(folder / "cut.h5", Mode::create);
    write(file, "a", counting<double>(1000), {1000});
  }
  std::filesystem::resize_file(folder / "cut.h5", 5000);
  EXPECT_TRUE(contains(open(folder / "cut.h5"), "it is cut short"));

  const std::string nowhere = (folder / "no/such/folder.h5").string();
  EXPECT_EQ(message_of([&] { Hdf5File(nowhere, Mode::create); }),
            "cannot write " + nowhere + ": No such file or directory");
}

TEST(Hdf5File, RefusesWrongExtentsTypesAndNames) {
  const TemporaryFolder folder;
  Hdf5File file(folder / "a.h5", Mode::create);
  write(file, "a", counting<double>(6), {2, 3});
  EXPECT_THROW(write(file, "b", counting<double>(6), {2, 4}), Hdf5Error);
  EXPECT_THROW(write(file, "b", counting<double>(6), {}), Hdf5Error);
  EXPECT_THROW(write(file, "a", counting<double>(6), {6}), Hdf5Error);  // exists
  EXPECT_THROW(file.read<double>("a", {3, 2}), Hdf5Error);
  EXPECT_THROW(file.read<std::int64_t>("a"), Hdf5Error);
  EXPECT_THROW(file.read<double>("none/such"), Hdf5Error);
  EXPECT_FALSE(file.exists("none/such"));
  const auto text = message_of([&] { file.read<double>("a", {3, 2}); });
  EXPECT_TRUE(contains(text, "2 x 3") && contains(text, "3 x 2")) << text;
}

TEST(Hdf5File, ExtentsBeyondTheFileAreNotBelieved) {
  const TemporaryFolder folder;
  constexpr std::uint64_t marked = 0x1234;  // found again in the header of the array
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    write(file, "a", counting<double>(marked), {marked});
  }
  std::fstream raw(folder / "a.h5", std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes = read_text(folder / "a.h5");
  // Two dimension fields hold the extent: the current and the largest size.
  const std::string extent("\x34\x12\0\0\0\0\0\0", 8),
      absurd("\xff\xff\xff\xff\xff\xff\xff\x0f", 8);
  int replaced = 0;
  for (auto at = bytes.find(extent); at != std::string::npos; at = bytes.find(extent, at + 8)) {
    raw.seekp(static_cast<std::streamoff>(at));
    raw.write(absurd.data(), 8);
    ++replaced;
  }
  raw.close();
  ASSERT_GE(replaced, 1);
  const Hdf5File file(folder / "a.h5", Mode::read);
  const auto text = message_of([&] { file.read<double>("a"); });
  EXPECT_TRUE(contains(text, "more than the file can hold")) << text;
}

TEST(Hdf5File, AFullDiskIsAnException) {
  const TemporaryFolder folder;
  for (const rlim_t limit : {1000u, 50000u, 200000u}) {
    const FileSizeLimit full(limit);
    const auto text = message_of([&] {
      Hdf5File file(folder / "full.h5", Mode::create);
      write(file, "a", counting<double>(100000), {100000});
      file.close();
    });
    EXPECT_TRUE(contains(text, "cannot write " + (folder / "full.h5").string())) << text;
    EXPECT_TRUE(contains(text, "File too large")) << text;
  }
  // A small array may fit into the library's buffers: then close() must complain.
  const FileSizeLimit full(100);
  EXPECT_THROW(
      {
        Hdf5File file(folder / "small.h5", Mode::create);
        file.set_attribute("/", "x", 1.0);
        file.close();
      },
      Hdf5Error);
}

TEST(Hdf5File, EqualContentGivesEqualFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) {
    Hdf5File file(folder / name, Mode::create);
    write(file, "g/a", counting<double>(10), {10});
    file.set_attribute("g", "t", 1.5);
  }
  EXPECT_FALSE(read_text(folder / "a").empty());
  EXPECT_EQ(read_text(folder / "a"), read_text(folder / "b"));
}

TEST(Hdf5File, AHiddenGroupAppearsWhenPublished) {
  const TemporaryFolder folder;
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    file.begin_hidden_group("frame");
    write(file, "frame/a", counting<double>(3), {3});
    file.set_attribute("frame", "time", 2.0);
    EXPECT_TRUE(file.children().empty());
    file.publish_group();
  }
  {
    Hdf5File file(folder / "a.h5", Mode::modify);
    EXPECT_EQ(file.children(), std::vector<std::string>{"frame"});
    file.begin_hidden_group("dropped");
    write(file, "dropped/a", counting<double>(3), {3});
  }
  const Hdf5File file(folder / "a.h5", Mode::read);
  EXPECT_EQ(file.children(), std::vector<std::string>{"frame"});
  EXPECT_EQ(file.read<double>("frame/a"), counting<double>(3));
  EXPECT_EQ(file.attribute<double>("frame", "time"), 2.0);
}

TEST(Provenance, ComesBackAndMayBeMissing) {
  const TemporaryFolder folder;
  Hdf5File file(folder / "a.h5", Mode::create);
  EXPECT_EQ(read_provenance(file).title, "");
  write_provenance(file, {"T", "[case]\n", "1", "abc", "OpenMP"});
  const Provenance back = read_provenance(file);
  EXPECT_EQ(back.title, "T");
  EXPECT_EQ(back.config, "[case]\n");
  EXPECT_EQ(back.version, "1");
  EXPECT_EQ(back.git_hash, "abc");
  EXPECT_EQ(back.backend, "OpenMP");
}

}  // namespace
}  // namespace barchan
