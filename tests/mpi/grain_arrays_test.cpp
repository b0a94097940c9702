// An array that is given to the grains goes wherever their other arrays go.
#include <gtest/gtest.h>

#include "src/coupling/fluid_side_grains.hpp"
#include "src/grains/neighbor_list.hpp"
#include "src/initial/grain_files.hpp"
#include "src/parallel/reduce.hpp"
#include "src/restart/grain_state_file.hpp"
#include "tests/support/grain_cases.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

constexpr std::array<double, 3> size{0.006, 0.003, 0.005};
constexpr int n_grains = 3000;

Config box() {
  Config c = test::grain_config();
  c.size = size;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  return c;
}

void add_mark(GrainState& s) {
  add_extra(s, "mark", "m/s", kRestart | kGhosts | kGatherReads | kGatherWrites);
}

/// The mark of a grain is a number that no other grain has: its velocity along x.
void set_marks(const GrainState& s, Real sign = 1) {
  const auto mark = s.extra.at(0).values;
  const auto kin = s.kin;
  Kokkos::parallel_for(
      "test: mark", s.n, KOKKOS_LAMBDA(int g) { mark(g) = sign * kin(g).u.x; });
}

/// Rows, ghosts included, with the mark of another grain; of all ranks.
std::int64_t wrong_marks(const GrainState& s, Real sign = 1) {
  const auto mark = s.extra.at(0).values;
  const auto kin = s.kin;
  int wrong = 0;
  Kokkos::parallel_reduce(
      "test: wrong marks", s.n + s.n_ghosts,
      KOKKOS_LAMBDA(int g, int& sum) { sum += mark(g) != sign * kin(g).u.x; }, wrong);
  return sum_over(MPI_COMM_WORLD, wrong);
}

const std::vector<std::string> kHeaps{"upstream", "in the middle", "downstream"};

KOKKOS_FUNCTION std::uint8_t heap_of(std::int64_t id) { return static_cast<std::uint8_t>(id % 3); }

/// Grains with the heap of another one; of all ranks.
std::int64_t wrong_heaps(const GrainState& s) {
  const auto heap = s.heap;
  const auto id = s.id;
  int wrong = 0;
  Kokkos::parallel_reduce(
      "test: wrong heaps", s.n,
      KOKKOS_LAMBDA(int g, int& sum) { sum += heap(g) != heap_of(id(g)); }, wrong);
  return sum_over(MPI_COMM_WORLD, wrong);
}

/// Grains in free flight, marked, through lists that sort them and send them to other ranks.
struct Marked {
  Marked() : list(box(), grains.r_max, MPI_COMM_WORLD) {
    add_mark(grains);
    set_marks(grains);
    for (int round = 0; round < 10; ++round) {
      list.rebuild(grains, false);
      test::drift(grains, 6e-5);
    }
    list.rebuild(grains, false);
  }
  GrainState grains = make_grain_state(still_along_y(), 2500, MPI_COMM_WORLD);
  NeighborList list;

  static InitialGrains still_along_y() {  // there is no floor
    InitialGrains grains = test::random_grains(n_grains, size, 5);
    for (Vec3& u : grains.u) u.y = 0;
    for (const std::int64_t id : grains.id) grains.heap.push_back(heap_of(id));
    grains.heap_names = kHeaps;
    return grains;
  }
};

TEST(GrainArrays, AnExtraOneIsSortedAndMigratesAndGhostsHaveIt) {
  Marked m;
  EXPECT_EQ(sum_over(MPI_COMM_WORLD, m.grains.n), n_grains);
  if (rank_count(MPI_COMM_WORLD) > 1) {
    EXPECT_GT(sum_over(MPI_COMM_WORLD, m.list.n_migrated()), 100);
    EXPECT_GT(sum_over(MPI_COMM_WORLD, m.grains.n_ghosts), 100);
  }
  EXPECT_EQ(wrong_marks(m.grains), 0);
  EXPECT_EQ(wrong_heaps(m.grains), 0);
  set_marks(m.grains, 2);  // the marks that are compared are not those of the start
  EXPECT_GE(wrong_marks(m.grains), n_grains);
}

/// The history with wall h is h + 1 times the velocity, which no other grain has, the torque the
/// opposite. Writes them, or counts the grains with those of another grain or wall; of all ranks.
std::int64_t wrong_walls(const GrainState& s, bool write) {
  const auto xi_t = s.wall_xi_t, torque = s.wall_torque;
  const auto touching = s.wall_touching;
  const auto kin = s.kin;
  const auto id = s.id;
  int wrong = 0;
  Kokkos::parallel_reduce(
      "test: walls", s.n,
      KOKKOS_LAMBDA(int g, int& sum) {
        const auto bits = static_cast<std::uint8_t>(id(g) % 256);
        bool differs = touching(g) != bits;
        if (write) touching(g) = bits;
        for (int h = 0; h < xi_t.extent_int(1); ++h) {
          const Vec3 mark = Real(h + 1) * kin(g).u;
          differs = differs || norm(xi_t(g, h) - mark) > 0 || norm(torque(g, h) + mark) > 0;
          if (write) xi_t(g, h) = mark, torque(g, h) = -mark;
        }
        sum += differs;
      },
      wrong);
  return sum_over(MPI_COMM_WORLD, wrong);
}

/// Histories: as many as walls can have.
TEST(GrainArrays, HistoriesOfAllWallsMigrate) {
  GrainState grains = make_grain_state(Marked::still_along_y(), 2500, MPI_COMM_WORLD);
  grains.wall_xi_t = decltype(grains.wall_xi_t)("wall xi_t", grains.kin.extent(0), 5);
  grains.wall_torque = decltype(grains.wall_torque)("wall torque", grains.kin.extent(0), 5);
  EXPECT_GE(wrong_walls(grains, true), n_grains - n_grains / 256);
  NeighborList list(box(), grains.r_max, MPI_COMM_WORLD);
  for (int round = 0; round < 10; ++round) {
    list.rebuild(grains, false);
    ASSERT_EQ(wrong_walls(grains, false), 0) << "round " << round;
    test::drift(grains, 6e-5);
  }
  EXPECT_TRUE(rank_count(MPI_COMM_WORLD) == 1 || sum_over(MPI_COMM_WORLD, list.n_migrated()) > 100);
}

TEST(GrainArrays, AnExtraOneGoesToTheFluidRanksAndBack) {
  Marked m;
  add_fluid(m.grains);
  const ForceSwitches forces{.lift = true, .torque = true};
  add_exchange(m.grains, forces);
  const test::SharedGrid grid({12, 4, 10}, size, 0);
  FluidSideGrains fluid_side(grid.mine, true, m.grains, forces);
  for (const Real sign : {-1, 3}) {
    GrainState& there = fluid_side.to_fluid_ranks(m.grains, kGatherReads);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, there.n), n_grains);
    EXPECT_EQ(wrong_marks(there, sign == -1 ? 1 : -1), 0);
    set_marks(there, sign);
    fluid_side.to_grain_ranks(m.grains, kGatherWrites);
    m.grains.n_ghosts = 0;  // they are not sent
    EXPECT_EQ(wrong_marks(m.grains, sign), 0);
  }
}

/// Reads them among the ranks of `ranks`.
GrainState read_back(const std::filesystem::path& file, MPI_Comm ranks) {
  const CheckpointReader reader(file, MPI_COMM_WORLD);
  GrainState grains = grains_in_file(reader, ranks);
  add_mark(grains);
  grains.wall_xi_t = decltype(grains.wall_xi_t)("wall xi_t", grains.kin.extent(0), 1);
  NeighborList list(box(), grains.r_max, ranks);
  load_grains(reader, grains, list);
  return grains;
}

TEST(GrainArrays, AnExtraOneIsInRestartFiles) {
  Marked m;
  m.grains.wall_xi_t = decltype(m.grains.wall_xi_t)("wall xi_t", m.grains.kin.extent(0), 1);
  const test::SharedFolder folder;
  CheckpointWriter writer(folder.path(), 1, {}, MPI_COMM_WORLD);
  save_grains(writer, m.grains, m.list);
  const auto file = writer.commit(1);
  const GrainState same = read_back(file, MPI_COMM_WORLD);
  EXPECT_EQ(same.n_ghosts, m.grains.n_ghosts);
  EXPECT_EQ(wrong_marks(same), 0);
  EXPECT_EQ(wrong_heaps(same), 0);
  EXPECT_EQ(same.heap_names, kHeaps);
  // Every rank alone reads all of them.
  const GrainState alone = read_back(file, MPI_COMM_SELF);
  EXPECT_EQ(alone.n, n_grains);
  EXPECT_EQ(wrong_marks(alone), 0);
  EXPECT_EQ(wrong_heaps(alone), 0);
}

TEST(GrainArrays, TheHeapsOfASettledStateAreThoseOfTheNextCase) {
  Marked m;
  const test::SharedFolder folder;
  CheckpointWriter writer(folder.path(), 1, {}, MPI_COMM_WORLD);
  save_grains(writer, m.grains, m.list);
  const InitialGrains settled = read_grains(writer.commit(1));
  ASSERT_EQ(settled.size(), std::size_t{n_grains});
  EXPECT_EQ(wrong_heaps(make_grain_state(settled, 2500, MPI_COMM_WORLD)), 0);
  EXPECT_EQ(settled.heap_names, kHeaps);
}

}  // namespace
}  // namespace barchan
