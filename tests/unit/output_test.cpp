#include "src/results/output_files.hpp"

#include <gtest/gtest.h>

#include "src/base/atomic_file.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/mirror.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

constexpr int nx = 5, ny = 4, nz = 3;
const std::vector<double> y_faces{0.0, 0.1, 0.3, 0.7, 1.5};

Grid awkward_grid() {
  Grid grid = make_grid(nx, nz, nx * 0.5, nz * 0.25, y_faces);
  const auto host = host_copy(grid.y_face_);
  host(0) = host(ny + 2) = -99;  // ghosts must not be written
  Kokkos::deep_copy(grid.y_face_, host);
  return grid;
}

FluidState make_flow() {
  const FluidState flow = make_fluid_state(awkward_grid());
  const auto set = [&](const Field& f, auto value) { test::set_everywhere(f, flow.grid, value); };
  set(flow.u.x, [](int i, int j, int k) { return i + 10 * j + 100 * k; });
  set(flow.u.y, [](int i, int j, int k) { return 100 * i + j * j + k; });
  set(flow.u.z, [](int i, int j, int k) { return i + j + 8 * k; });
  set(flow.p, [](int i, int j, int k) { return i + 10 * j + 100 * k; });
  set(flow.alpha_f, [](int, int, int) { return 0.5; });
  set(flow.nu_t, [](int, int j, int) { return 1e-6 * j; });
  return flow;
}

std::size_t cell(int i, int j, int k) {
  return static_cast<std::size_t>(i) +
         nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Output, FieldsAreCentredWithoutGhosts) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {.title = "flow", .config = "[case]\n"});
  const FluidState flow = make_flow();
  output.write_fields(flow, 0.5, 2000);

  const Hdf5File file(folder / "fields.h5", Hdf5File::Mode::read);
  const Extents cells{nz, ny, nx};
  const auto u = file.read<double>("frame_000000/u", cells);
  const auto v = file.read<double>("frame_000000/v", cells);
  const auto w = file.read<double>("frame_000000/w", cells);
  const auto p = file.read<double>("frame_000000/p", cells);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        EXPECT_EQ(u[cell(i, j, k)], i + 0.5 + 10 * j + 100 * k);
        EXPECT_EQ(v[cell(i, j, k)], 100 * i + 0.5 * (j * j + (j + 1) * (j + 1)) + k);
        EXPECT_EQ(w[cell(i, j, k)], i + j + 8 * (k + 0.5));
        EXPECT_EQ(p[cell(i, j, k)], i + 10 * j + 100 * k);
      }
    }
  }
  EXPECT_EQ(file.attribute<double>("frame_000000", "time"), 0.5);
  EXPECT_EQ(file.attribute<std::int64_t>("frame_000000", "step"), 2000);
  EXPECT_EQ(file.attribute<std::string>("frame_000000/p", "units"), "Pa");
  EXPECT_EQ(file.attribute<std::string>("/", "title"), "flow");
  EXPECT_EQ(file.attribute<std::string>("/", "config"), "[case]\n");

  EXPECT_EQ(file.read<double>("grid/y_face", {ny + 1}), y_faces);
  EXPECT_EQ(file.read<double>("grid/x_face", {nx + 1}).back(), 2.5);
  EXPECT_EQ(file.read<double>("grid/z_face", {nz + 1}).back(), nz * 0.25);
  EXPECT_EQ(file.read<double>("grid/x", {nx}).front(), 0.25);
  EXPECT_DOUBLE_EQ(file.read<double>("grid/y", {ny}).back(), 1.1);
}

TEST(Output, FieldsXdmfPointsAtTheArrays) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  const FluidState flow = make_flow();
  output.write_fields(flow, 0, 0);
  output.write_fields(flow, 0.25, 1000);
  const std::string text = read_text(folder / "fields.xdmf");
  EXPECT_EQ(count(text, "<Grid Name=\"frame_"), 2);
  EXPECT_EQ(count(text, "CollectionType=\"Temporal\""), 1);
  EXPECT_EQ(count(text, "TopologyType=\"3DRectMesh\" Dimensions=\"4 5 6\""), 2);
  EXPECT_EQ(count(text, "Center=\"Cell\""), 12);
  EXPECT_EQ(count(text, "Precision=\"4\" Dimensions=\"3 4 5\">fields.h5:/frame_000001/p<"), 1);
  EXPECT_EQ(count(text, "Precision=\"8\" Dimensions=\"6\">fields.h5:/grid/x_face<"), 2);
  EXPECT_EQ(count(text, "<Time Value=\"0.25\"/>"), 1);
  // The order is x, y, z.
  EXPECT_LT(text.find("x_face"), text.find("y_face"));
  EXPECT_LT(text.find("y_face"), text.find("z_face"));
}

/// Two rows more than grains.
GrainState make_grains(int n) {
  InitialGrains g;
  for (int q = 0; q < n + 2; ++q) {
    g.id.push_back(1000 - q);
    g.diameter.push_back(2e-4 * (q + 1));
    g.x.push_back({q + 0.1, q + 0.2, q + 0.3});
    g.u.push_back({1.0 + q, 2.0, 3.0});
    g.omega.push_back({4.0, 5.0, 6.0 + q});
  }
  GrainState grains = make_grain_state(g, 2500);
  grains.n = n;
  return grains;
}

/// Every array says in its attributes what it is and in which unit.
void expect_described(const std::filesystem::path& path, const std::string& group) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  const auto names = file.children(group);
  EXPECT_FALSE(names.empty());
  for (const std::string& name : names) {
    const std::string array = group + "/" + name;
    ASSERT_TRUE(file.has_attribute(array, "units") && file.has_attribute(array, "long_name"));
    EXPECT_NE(file.attribute<std::string>(array, "long_name"), "") << array;
  }
}

TEST(Output, ArraysSayWhatTheyAre) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  output.write_fields(make_flow(), 0, 0);
  const Kokkos::View<Vec3*> force("force", 5);
  const ForceArrays forces{.flow = force,
                           .torque = force,
                           .drag = force,
                           .added_mass = force,
                           .lift = force,
                           .pressure_gradient = force,
                           .stress = force,
                           .contact = force,
                           .contact_normal = force,
                           .contact_tangential = force,
                           .total = force};
  GrainState grains = make_grains(3);
  add_heaps(grains, {"west", "east"});
  output.write_grains(grains, 0, 0, forces, std::vector<int>{0, -1, 1});
  output.write_tracks(make_grains(3), 0, 0, std::vector<int>{0, -1, 1});
  expect_described(folder / "fields.h5", "frame_000000");
  expect_described(folder / "fields.h5", "grid");
  expect_described(folder / "grains.h5", "frame_000000");
  expect_described(folder / "tracks.h5", "frame_000000");
  const Hdf5File file(folder / "grains.h5", Hdf5File::Mode::read);
  EXPECT_EQ(file.attribute<std::string>("frame_000000/d", "long_name"), "diameter");
}

TEST(Output, GrainsAreTheOnesInside) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  const Kokkos::View<Vec3*> drag("drag", 5);
  Kokkos::deep_copy(drag, Vec3{1e-9, 2e-9, 3e-9});
  output.write_grains(make_grains(3), 0.1, 400, {.drag = drag}, std::vector<int>{0, -1, 1});

  const Hdf5File file(folder / "grains.h5", Hdf5File::Mode::read);
  EXPECT_EQ(file.read<std::int64_t>("frame_000000/id", {3}),
            (std::vector<std::int64_t>{1000, 999, 998}));
  const auto x = file.read<double>("frame_000000/x", {3, 3});
  EXPECT_EQ(x[5], 1.3);  // double precision: exact
  EXPECT_EQ(file.read<double>("frame_000000/d", {3})[2], 2 * (1e-4 * 3));
  EXPECT_EQ(file.read<double>("frame_000000/u", {3, 3})[6], 3.0);
  EXPECT_EQ(file.read<double>("frame_000000/omega", {3, 3})[8], 8.0);
  EXPECT_FLOAT_EQ(file.read<float>("frame_000000/force_drag", {3, 3})[4], 2e-9f);
  EXPECT_EQ(file.attribute<std::string>("frame_000000/force_drag", "units"), "N");
  EXPECT_EQ(file.info("frame_000000/x").type, ElementType::float64);
  EXPECT_EQ(file.read<std::int32_t>("frame_000000/dune", {3}), (std::vector<int>{0, -1, 1}));
  EXPECT_EQ(
      count(read_text(folder / "grains.xdmf"),
            "NumberType=\"Int\" Precision=\"4\" Dimensions=\"3\">grains.h5:/frame_000000/dune<"),
      1);
}

TEST(Output, GrainsXdmfPointsAtTheArraysAndSkipsEmptyFrames) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  output.write_grains(make_grains(3), 0.0, 0);
  output.write_grains(make_grains(1), 0.1, 1);
  output.write_grains(make_grains(0), 0.2, 2);
  EXPECT_EQ(list_frames(Hdf5File(folder / "grains.h5", Hdf5File::Mode::read)).size(), 3u);
  const std::string text = read_text(folder / "grains.xdmf");
  EXPECT_EQ(count(text, "<Grid Name=\"frame_"), 2);
  EXPECT_EQ(count(text, "TopologyType=\"Polyvertex\" NumberOfElements=\"3\""), 1);
  EXPECT_EQ(count(text, "NumberOfElements=\"1\""), 1);
  EXPECT_EQ(count(text, "Precision=\"8\" Dimensions=\"3 3\">grains.h5:/frame_000000/x<"), 1);
  EXPECT_EQ(count(text, "<Attribute Name=\"u\" AttributeType=\"Vector\" Center=\"Node\">"), 2);
  EXPECT_EQ(count(text, "<Attribute Name=\"d\" AttributeType=\"Scalar\" Center=\"Node\">"), 2);
  EXPECT_EQ(count(text, "NumberType=\"Int\" Precision=\"8\" Dimensions=\"3\""), 1);
}

TEST(Output, TracksAreIdsAndPositions) {
  const TemporaryFolder folder;
  const GrainState grains = make_grains(4);
  OutputFiles(folder.path(), {}).write_tracks(grains, 0.1, 10);
  const Hdf5File file(folder / "tracks.h5", Hdf5File::Mode::read);
  const auto frames = list_frames(file);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_DOUBLE_EQ(frames[0].t, 0.1);
  EXPECT_EQ(frames[0].arrays.size(), 2u);
  EXPECT_EQ(file.read<std::int64_t>("frame_000000/id", {4}).size(), 4u);
  const auto x = file.read<double>("frame_000000/x", {4, 3});
  const auto kin = host_copy(grains.kin);
  for (int g = 0; g < grains.n; ++g) {
    EXPECT_NEAR(x[3 * static_cast<std::size_t>(g) + 1], kin(g).x.y, 1e-6 * std::abs(kin(g).x.y));
  }
}

/// A grain may be beyond a periodic side between two rebuilds of the list. In a file it is within,
/// also where single precision would round it to the end.
TEST(Output, PositionsAreWithinThePeriod) {
  const TemporaryFolder folder;
  constexpr double lx = 0.012, lz = 0.006;
  const GrainState grains = make_grains(4);
  const auto kin = mirror(grains.kin);
  kin(0).x = {-8e-6, 1e-3, lz + 4e-6};
  kin(1).x = {lx, 1e-3, lz * (1 - 1e-12)};
  kin(2).x = {lx * (1 - 1e-12), 1e-3, -1e-30};
  kin(3).x = {0.003, -1e-5, 0.002};
  Kokkos::deep_copy(grains.kin, kin);
  OutputFiles output(folder.path(), {}, {}, MPI_COMM_SELF, {.lx = lx, .lz = lz});
  output.write_grains(grains, 0, 0);
  output.write_tracks(grains, 0, 0);
  for (const char* name : {"grains.h5", "tracks.h5"}) {
    const Hdf5File file(folder / name, Hdf5File::Mode::read);
    const auto x = file.read<double>("frame_000000/x", {4, 3});
    for (std::size_t g = 0; g < 4; ++g) {
      EXPECT_GE(x[3 * g], 0) << name << ", grain " << g;
      EXPECT_LT(x[3 * g], lx) << name << ", grain " << g;
      EXPECT_GE(x[3 * g + 2], 0) << name << ", grain " << g;
      EXPECT_LT(x[3 * g + 2], lz) << name << ", grain " << g;
    }
    EXPECT_NEAR(x[0], lx - 8e-6, 1e-9);
    EXPECT_NEAR(x[2], 4e-6, 1e-9);
    EXPECT_NEAR(x[10], -1e-5, 1e-12) << "below the floor is no side";
  }
}

TEST(Output, ARestartGoesOnWithFilesAndDescriptions) {
  const TemporaryFolder folder;
  {
    OutputFiles output(folder.path(), {});
    for (int k = 0; k < 4; ++k) output.write_grains(make_grains(2), 0.1 * k, k);
    for (int k = 0; k < 3; ++k) output.write_fields(make_flow(), 0.2 * k, 2 * k);
  }
  OutputFiles output(folder.path(), {}, 0.2);
  EXPECT_EQ(count(read_text(folder / "grains.xdmf"), "<Time"), 3);
  EXPECT_EQ(count(read_text(folder / "fields.xdmf"), "<Time"), 2);
  output.write_grains(make_grains(2), 0.3, 3);
  const auto frames = list_frames(Hdf5File(folder / "grains.h5", Hdf5File::Mode::read));
  EXPECT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames.back().name, "frame_000003");
  EXPECT_EQ(count(read_text(folder / "grains.xdmf"), "<Time"), 4);
  const Hdf5File fields(folder / "fields.h5", Hdf5File::Mode::read);
  EXPECT_EQ(fields.children(), (std::vector<std::string>{"frame_000000", "frame_000001", "grid"}));
}

}  // namespace
}  // namespace barchan
