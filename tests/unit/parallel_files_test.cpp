// Result and restart files written by all ranks together; script.parallel_files runs these on two
// ranks, the unit tests on one.
#include <gtest/gtest.h>

#include <array>

#include "src/diagnostics/gathered_grains.hpp"
#include "src/fluid/domain.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/shared_folder.hpp"

namespace barchan {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

constexpr int nx = 3, ny = 2, nz = 2;  // of each rank; the ranks follow each other along x

FluidState flow_of(int rank, const Decomposition* pencils) {
  const int wide = nx * rank_count(world);
  FluidState flow = make_fluid_state(make_grid(wide, nz, wide, nz, {0, 1, 2}, pencils));
  Kokkos::deep_copy(flow.p.storage, 10.0 + rank);
  return flow;
}

/// Rank r has r grains: none on the first.
GrainState grains_of(int rank) {
  GrainState grains = make_grain_entries(rank, world);
  Kokkos::deep_copy(grains.id, rank);
  return grains;
}

TEST(ParallelFiles, FramesHoldTheSharesOfAllRanks) {
  const int ranks = rank_count(world), rank = rank_of(world);
  const test::SharedFolder folder;
  const Decomposition pencils(world, nx * ranks, nz);
  const auto n = static_cast<std::size_t>(rank);
  const std::vector<double> all = on_rank_0(world, std::vector<double>(n, rank));
  const DuneLabels dunes = from_rank_0(world, std::vector<int>(all.begin(), all.end()), rank);
  {
    OutputFiles output(folder.path(), {.title = "parallel"}, {}, world);
    for (int k = 0; k < 3; ++k) {
      output.write_fields(flow_of(rank, &pencils), k, k);
      output.write_grains(grains_of(rank), k, k, {}, dunes);
    }
  }
  OutputFiles output(folder.path(), {.title = "parallel"}, 1.0, world);
  output.write_fields(flow_of(rank, &pencils), 2, 2);

  const Hdf5File fields(folder.path() / "fields.h5", Hdf5File::Mode::read, world);
  EXPECT_EQ(list_frames(fields).size(), 3u);
  const auto wide = static_cast<std::uint64_t>(nx) * static_cast<std::uint64_t>(ranks);
  const auto p = fields.read<double>("frame_000002/p", {nz, ny, wide});
  for (std::size_t c = 0; c < p.size(); ++c) {
    EXPECT_EQ(p[c], 10.0 + static_cast<double>(c % wide / nx));
  }
  EXPECT_EQ(fields.read<double>("grid/x_face", {wide + 1}).back(), static_cast<double>(wide));
  const Hdf5File grains(folder.path() / "grains.h5", Hdf5File::Mode::read, world);
  std::vector<std::int64_t> ids;
  for (int r = 0; r < ranks; ++r) ids.insert(ids.end(), static_cast<std::size_t>(r), r);
  EXPECT_EQ(grains.read<std::int64_t>("frame_000001/id"), ids);
  EXPECT_EQ(grains.read<std::int64_t>("frame_000001/dune"), ids);
  EXPECT_EQ(grains.info("frame_000001/x").extents, (Extents{ids.size(), 3}));
}

TEST(ParallelFiles, ARestartFileHoldsTheSharesOfAllRanks) {
  const auto ranks = static_cast<std::uint64_t>(rank_count(world));
  const auto rank = static_cast<std::uint64_t>(rank_of(world));
  const test::SharedFolder folder;
  const std::vector<double> mine(2, static_cast<double>(rank));
  CheckpointWriter writer(folder.path(), 5, {}, world);
  writer.scalar("t", 0.25);
  writer.array("a", std::span<const double>(mine), {2},
               {.whole = {2 * ranks}, .first = {2 * rank}});
  const CheckpointReader reader(writer.commit(1), world);
  EXPECT_EQ(reader.real("t"), 0.25);
  const auto all = reader.array<double>("a", {2 * ranks});
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<double>(i / 2));
}

}  // namespace
}  // namespace barchan
