// HDF5 files that somebody else made, or that were damaged: found by the targets in tests/fuzz/.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "src/app/info.hpp"
#include "src/initial/grain_files.hpp"
#include "src/io/frame_file.hpp"
#include "src/io/hdf5_handle.hpp"
#include "src/io/seal.hpp"
#include "src/restart/checkpoint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using hdf5::Handle;

/// A result file of two grains.
struct TwoGrains {
  std::vector<std::int64_t> id{1, 2};
  std::vector<double> d{2e-4, 2e-4}, x{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, u{1, 2, 3, 4, 5, 6};
};

std::filesystem::path write(const TemporaryFolder& folder, const TwoGrains& grains) {
  FrameFile file(folder / "grains.h5", {}, {}, MPI_COMM_SELF);
  file.append(
      0, 0, [](Hdf5File&) {},
      [&](Hdf5File& h, const std::string& group) {
        h.write<std::int64_t>(group + "/id", grains.id, {2}, "1");
        h.write<double>(group + "/d", grains.d, {2}, "m");
        h.write<double>(group + "/x", grains.x, {2, 3}, "m");
        h.write<double>(group + "/u", grains.u, {2, 3}, "m/s");
        h.write<double>(group + "/omega", grains.u, {2, 3}, "rad/s");
      });
  return folder / "grains.h5";
}

/// Calls edit(file) on the file opened by the library itself.
template <class Edit>
void edit(const std::filesystem::path& path, const Edit& edit) {
  hdf5::start_library();
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  ASSERT_GE(file.get(), 0);
  edit(file.get());
}

TEST(ForeignFiles, GrainsAreAsSoundAsThoseOfATable) {
  const TemporaryFolder folder;
  const auto problem = [&](const TwoGrains& grains) {
    return message_of([&] { read_grains(write(folder, grains)); });
  };
  EXPECT_EQ(problem({}), "");
  EXPECT_TRUE(contains(problem({.d = {2e-4, -2e-4}}), "grain 2 has a diameter of -0.0002 m"));
  EXPECT_TRUE(
      contains(problem({.d = {std::numeric_limits<double>::infinity(), 1}}), "grain 1 has"));
  EXPECT_TRUE(contains(problem({.u = {1, 2, 3, 4, 5, std::numeric_limits<double>::quiet_NaN()}}),
                       "grain 2 has a position or velocity that is not finite"));
  EXPECT_TRUE(contains(problem({.id = {7, 7}}), "grain 7 is in it twice"));
}

TEST(ForeignFiles, GroupsInACircleAreNotFollowedForEver) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder.path(), 3, {});
  writer.scalar("t", 0.5);
  const auto path = writer.commit(1);
  edit(path, [](hid_t file) {
    H5Lcreate_hard(file, "/", file, "/scalars/loop", H5P_DEFAULT, H5P_DEFAULT);
  });
  seal(path);
  EXPECT_TRUE(contains(describe_file(path), "scalars/loop/scalars/loop"));
}

TEST(ForeignFiles, ALinkToAnotherFileIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::copy(write(folder, {}), folder / "other.h5");
  edit(folder / "grains.h5", [](hid_t file) {
    H5Ldelete(file, "frame_000000/u", H5P_DEFAULT);
    H5Lcreate_external("other.h5", "frame_000000/u", file, "frame_000000/u", H5P_DEFAULT,
                       H5P_DEFAULT);
  });
  EXPECT_TRUE(contains(message_of([&] { read_grains(folder / "grains.h5"); }), "cannot read"));
}

TEST(ForeignFiles, AnArrayMadeOfItselfIsRefused) {
  const TemporaryFolder folder;
  const auto path = write(folder, {});
  edit(path, [](hid_t file) {
    const std::array<hsize_t, 1> extent{2};
    const Handle space(H5Screate_simple(1, extent.data(), nullptr), H5Sclose);
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_virtual(list.get(), space.get(), ".", "frame_000000/id", space.get());
    H5Ldelete(file, "frame_000000/id", H5P_DEFAULT);
    const Handle array(H5Dcreate2(file, "frame_000000/id", H5T_NATIVE_INT64, space.get(),
                                  H5P_DEFAULT, list.get(), H5P_DEFAULT),
                       H5Dclose);
  });
  EXPECT_TRUE(contains(message_of([&] { read_grains(path); }), "its values lie elsewhere"));
}

TEST(ForeignFiles, ExtentsOfValuesThatWereNeverStoredAreNotBelieved) {
  const TemporaryFolder folder;
  const auto path = write(folder, {});
  edit(path, [](hid_t file) {
    const std::array<hsize_t, 1> extent{1000000}, chunk{1000};
    const Handle space(H5Screate_simple(1, extent.data(), nullptr), H5Sclose);
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(list.get(), 1, chunk.data());
    const Handle array(H5Dcreate2(file, "empty", H5T_NATIVE_INT8, space.get(), H5P_DEFAULT,
                                  list.get(), H5P_DEFAULT),
                       H5Dclose);
  });
  const Hdf5File file(path, Hdf5File::Mode::read);
  EXPECT_TRUE(contains(message_of([&] { file.read<double>("empty"); }), "more than the file can"));
}

}  // namespace
}  // namespace barchan
