#include "src/restart/checkpoint.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <fstream>

#include "src/grains/grain_state.hpp"
#include "src/parallel/mirror.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const Provenance origin{"T", "[case]\n", "0.1", "abc", "OpenMP"};

std::filesystem::path write_empty(const std::filesystem::path& folder, std::int64_t step,
                                  int keep) {
  CheckpointWriter writer(folder, step, origin);
  writer.scalar("t", 0.001 * static_cast<double>(step));
  return writer.commit(keep);
}

std::vector<std::int64_t> steps_in(const std::filesystem::path& folder) {
  std::vector<std::int64_t> steps;
  for (const auto& [step, file] : list_checkpoints(folder)) steps.push_back(step);
  return steps;
}

/// A view of another layout than the stored one, with different extents per index.
template <class View>
void fill(const View& view) {
  const auto host = mirror(view);
  int value = 1;
  for (std::size_t i = 0; i < host.extent(0); ++i) {
    for (std::size_t j = 0; j < host.extent(1); ++j) host(i, j) = value++;
  }
  Kokkos::deep_copy(view, host);
}

template <class A, class B>
void expect_equal(const A& a, const B& b) {
  const auto x = host_copy(a);
  const auto y = host_copy(b);
  ASSERT_EQ(x.extent(0), y.extent(0));
  ASSERT_EQ(x.extent(1), y.extent(1));
  for (std::size_t i = 0; i < x.extent(0); ++i) {
    for (std::size_t j = 0; j < x.extent(1); ++j) EXPECT_EQ(x(i, j), y(i, j));
  }
}

TEST(Checkpoint, ScalarsAndSpansComeBack) {
  const TemporaryFolder folder;
  const std::vector<double> a{0.1, -0.0, 5e-324, 1e300};
  const std::vector<std::int64_t> b{std::int64_t{1} << 62, -1, 0};
  CheckpointWriter writer(folder.path(), 12000, origin);
  writer.scalar("t", 0.1 + 0.2);
  writer.scalar("fluid/steps", std::int64_t{3});
  writer.array("a", std::span<const double>(a));
  writer.array("fluid/b", std::span<const std::int64_t>(b), {3, 1});
  writer.array("none", std::span<const double>());
  const auto path = writer.commit(2);
  EXPECT_EQ(path, folder / "restart_0000012000.h5");

  const CheckpointReader reader(path);
  EXPECT_EQ(reader.step(), 12000);
  EXPECT_EQ(reader.real("t"), 0.1 + 0.2);
  EXPECT_EQ(reader.integer("fluid/steps"), 3);
  const auto back = reader.array<double>("a");
  ASSERT_EQ(back.size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(a[i]));
  }
  EXPECT_EQ(reader.array<std::int64_t>("fluid/b", {3, 1}), b);
  EXPECT_TRUE(reader.array<double>("none", {0}).empty());
  EXPECT_TRUE(reader.has("t") && reader.has("a") && reader.has("fluid/steps"));
  EXPECT_FALSE(reader.has("fluid/other") || reader.has("other"));
  EXPECT_EQ(reader.provenance().config, "[case]\n");
  EXPECT_EQ(reader.provenance().git_hash, "abc");
}

TEST(Checkpoint, ViewsOfAnyLayoutComeBack) {
  const TemporaryFolder folder;
  const Kokkos::View<double**, Kokkos::LayoutRight> right("right", 3, 5);
  const Kokkos::View<int**, Kokkos::LayoutLeft> left("left", 4, 2);
  fill(right);
  fill(left);
  const auto rows = std::make_pair(1, 3);
  const auto window = Kokkos::subview(left, rows, Kokkos::ALL);
  CheckpointWriter writer(folder.path(), 1, {});
  writer.array("right", right);
  writer.array("left", left);
  writer.array("window", window);
  const CheckpointReader reader(writer.commit(1));
  EXPECT_EQ(reader.extents("right"), (Extents{5, 3}));  // first index fastest on every backend
  EXPECT_EQ(reader.array<double>("right")[1], 6.0);     // (1, 0)

  const Kokkos::View<double**, Kokkos::LayoutLeft> right_back("back", 3, 5);
  const Kokkos::View<int**, Kokkos::LayoutRight> left_back("back", 4, 2);
  const Kokkos::View<int**, Kokkos::LayoutLeft> bigger("back", 4, 2);
  reader.array("right", right_back);
  reader.array("left", left_back);
  reader.array("window", Kokkos::subview(bigger, rows, Kokkos::ALL));
  expect_equal(right, right_back);
  expect_equal(left, left_back);
  expect_equal(window, Kokkos::subview(bigger, rows, Kokkos::ALL));
}

TEST(Checkpoint, ViewsOfStructsKeepEveryBit) {
  const TemporaryFolder folder;
  const Kokkos::View<GrainKinematics*> grains("grains", 2);
  const Kokkos::View<Vec3**, Kokkos::LayoutLeft> walls("walls", 2, 3);
  const Kokkos::View<std::uint8_t*> bits("bits", 2);
  const auto host = mirror(grains);
  host(0) = host(1) = GrainKinematics{};
  host(1).x = {0.1, 0.2, 0.3};
  host(1).m = 5e-324;
  host(1).omega = {-0.0, 1e-300, 7.0};
  Kokkos::deep_copy(grains, host);
  Kokkos::deep_copy(walls, Vec3{1, 2, 3});
  Kokkos::deep_copy(bits, std::uint8_t{200});
  CheckpointWriter writer(folder.path(), 1, {});
  writer.array("kin", grains);
  writer.array("walls", walls);
  writer.array("bits", bits);
  const CheckpointReader reader(writer.commit(1));
  EXPECT_EQ(reader.extents("walls"), (Extents{3, 2, 3}));

  const Kokkos::View<GrainKinematics*> grains_back("back", 2);
  const Kokkos::View<Vec3**, Kokkos::LayoutLeft> walls_back("back", 2, 3);
  const Kokkos::View<std::uint8_t*> bits_back("back", 2);
  reader.array("kin", grains_back);
  reader.array("walls", walls_back);
  reader.array("bits", bits_back);
  const auto back = host_copy(grains_back);
  const auto as_numbers = [](const GrainKinematics& grain) {
    std::array<std::uint64_t, sizeof(GrainKinematics) / 8> numbers{};
    std::memcpy(numbers.data(), &grain, sizeof(grain));
    return numbers;
  };
  for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(as_numbers(back(p)), as_numbers(host(p)));
  EXPECT_EQ(host_copy(walls_back)(1, 2).z, 3.0);
  EXPECT_EQ(host_copy(bits_back)(1), 200);
}

TEST(Checkpoint, AFileThatDoesNotFitIsRefusedInASentence) {
  const TemporaryFolder folder;
  const std::vector<double> a(6, 1.0);
  CheckpointWriter writer(folder.path(), 1, {});
  writer.array("fluid/p", std::span<const double>(a), {2, 3});
  writer.scalar("n", std::int64_t{1});
  const auto path = writer.commit(1);
  const CheckpointReader reader(path);
  const std::string start = "cannot restart from " + path.string() + ": ";
  EXPECT_EQ(message_of([&] {
              reader.array<double>("fluid/p", {3, 3});
            }),
            start + "fluid/p is 2 x 3 there and 3 x 3 in this run (another mesh, or other grains)");
  EXPECT_EQ(message_of([&] { reader.array<double>("fluid/q"); }),
            start + "it holds no \"fluid/q\", which this run needs");
  EXPECT_EQ(message_of([&] { reader.real("m"); }),
            start + "it holds no \"m\", which this run needs");
  EXPECT_EQ(message_of([&] { reader.array<std::int64_t>("fluid/p"); }),
            start + "fluid/p holds numbers of another type");
  EXPECT_NE(message_of([&] { reader.real("n"); }), "");
}

TEST(Checkpoint, ForeignFilesAreRefused) {
  const TemporaryFolder folder;
  { Hdf5File(folder / "other.h5", Hdf5File::Mode::create).close(); }
  EXPECT_EQ(message_of([&] { CheckpointReader(folder / "other.h5"); }),
            "cannot restart from " + (folder / "other.h5").string() + ": it is not a restart file");
}

TEST(Checkpoint, KeepsTheLastOnes) {
  const TemporaryFolder folder;
  for (const std::int64_t step : {100, 200, 300, 400}) write_empty(folder.path(), step, 2);
  EXPECT_EQ(steps_in(folder.path()), (std::vector<std::int64_t>{300, 400}));
  // A run that went back to 300 leaves the future of the other one behind.
  write_empty(folder.path(), 350, 2);
  EXPECT_EQ(steps_in(folder.path()), (std::vector<std::int64_t>{300, 350}));
  write_empty(folder.path(), 360, 0);
  EXPECT_EQ(steps_in(folder.path()), (std::vector<std::int64_t>{360}));
}

TEST(Checkpoint, TheLatestIsTheHighestStep) {
  const TemporaryFolder folder;
  EXPECT_FALSE(latest_checkpoint(folder.path()));
  EXPECT_FALSE(latest_checkpoint(folder / "no"));
  for (const char* name : {"restart_0000000009.h5", "restart_12345678901.h5",
                           "restart_0000000010.h5.tmp", "restart_x.h5", "restart_.h5"}) {
    std::ofstream(folder / name) << "x";
  }
  EXPECT_EQ(latest_checkpoint(folder.path()), folder / "restart_12345678901.h5");
}

TEST(Checkpoint, WithoutCommitNothingIsLeftAndNothingIsLost) {
  const TemporaryFolder folder;
  const auto first = write_empty(folder.path(), 1, 1);
  {
    CheckpointWriter writer(folder.path(), 2, {});
    writer.scalar("t", 1.0);
    EXPECT_TRUE(std::filesystem::exists(folder / "restart_0000000002.h5.tmp"));
  }
  const std::vector<double> big(100000);
  const auto text = message_of([&] {
    const FileSizeLimit full(200000);
    CheckpointWriter writer(folder.path(), 3, {});
    writer.array("a", std::span<const double>(big));
    writer.commit(1);
  });
  EXPECT_EQ(
      text.find("cannot write " + (folder / "restart_0000000003.h5").string() + ": File too large"),
      0u)
      << text;
  EXPECT_EQ(latest_checkpoint(folder.path()), first);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace barchan
