// The Verlet list against a search over all pairs.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/grain_cases.hpp"

namespace barchan {
namespace {

using test::drift;
using test::grain_config;
using test::handle_marks;
using test::random_grains;
using PairSet = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Pairs (by id) of the list; fails on a pair listed twice.
PairSet listed_pairs(const GrainState& s) {
  const auto i = host_copy(s.list.i);
  const auto j = host_copy(s.list.j);
  const auto id = host_copy(s.id);
  PairSet pairs;
  for (int p = 0; p < s.list.n_pairs; ++p) {
    EXPECT_TRUE(pairs.insert(std::minmax(id(i(p)), id(j(p)))).second) << "listed twice";
  }
  return pairs;
}

/// All pairs closer than the radii, and with_skins the skins, of both and the reach of the law, by
/// comparing each with each.
PairSet all_pairs(const GrainState& s, bool with_skins, Real lx, Real lz, Real reach = 0) {
  const auto kin = host_copy(s.kin);
  const auto id = host_copy(s.id);
  PairSet pairs;
  for (int a = 0; a < s.n; ++a) {
    for (int b = a + 1; b < s.n; ++b) {
      Vec3 d = kin(a).x - kin(b).x;
      if (lx > 0) d.x -= lx * std::round(d.x / lx);
      if (lz > 0) d.z -= lz * std::round(d.z / lz);
      const Real skins = with_skins ? kin(a).skin + kin(b).skin : 0;
      if (norm(d) < kin(a).r + kin(b).r + skins + reach) pairs.insert(std::minmax(id(a), id(b)));
    }
  }
  return pairs;
}

/// Moves every tenth grain beyond the outlet.
void push_out(const GrainState& s) {
  const auto kin = s.kin;
  const auto id = s.id;
  Kokkos::parallel_for(
      "test: push out", s.n, KOKKOS_LAMBDA(int g) {
        if (id(g) % 10 == 0) kin(g).x.x = 0.0101;
      });
}

void spoil(const GrainState& s, std::int64_t which) {
  const auto kin = s.kin;
  const auto id = s.id;
  Kokkos::parallel_for(
      "test: spoil", s.n, KOKKOS_LAMBDA(int g) {
        if (id(g) == which) kin(g).x.y = Kokkos::Experimental::quiet_NaN_v<Real>;
      });
}

/// Moves each grain by this part of its skin.
void use_up_skins(const GrainState& s, Real part) {
  const auto kin = s.kin;
  Kokkos::parallel_for(
      "test: use up skins", s.n,
      KOKKOS_LAMBDA(int g) { kin(g).x += (part * kin(g).skin / norm(kin(g).u)) * kin(g).u; });
}

/// Velocities to this part of what they are, but those of every twentieth grain.
void slow_down_most(const GrainState& s, Real part) {
  const auto kin = s.kin;
  const auto id = s.id;
  Kokkos::parallel_for(
      "test: slow down", s.n, KOKKOS_LAMBDA(int g) {
        if (id(g) % 20 != 0) kin(g).u = part * kin(g).u;
      });
}

struct Shape {
  GrainBoundaryX x;
  GrainBoundaryZ z;
  std::array<double, 3> size;
};

class NeighborListShapes : public ::testing::TestWithParam<Shape> {};

TEST_P(NeighborListShapes, NoPairIsMissedAndNoneIsListedTwice) {
  const Shape shape = GetParam();
  Config c = grain_config();
  c.size = shape.size;
  c.grains->boundary_x = shape.x;
  c.grains->boundary_z = shape.z;
  const Real lx = shape.x == GrainBoundaryX::periodic ? c.size[0] : 0;
  const Real lz = shape.z == GrainBoundaryZ::periodic ? c.size[2] : 0;
  for (const Real reach : {0.0, 1e-5}) {
    GrainState s = make_grain_state(random_grains(1200, c.size, 7), 2500);
    NeighborList list(c, s.r_max, MPI_COMM_SELF, reach);
    for (int round = 0; round < 3; ++round) {
      list.rebuild(s, false);
      EXPECT_EQ(listed_pairs(s), all_pairs(s, true, lx, lz, reach)) << "round " << round;
      use_up_skins(s, 0.999);
      const PairSet listed = listed_pairs(s), near = all_pairs(s, false, lx, lz, reach);
      EXPECT_FALSE(near.empty());
      for (const auto& pair : near) EXPECT_TRUE(listed.count(pair));
      drift(s, 3e-4);
    }
  }
}

TEST_P(NeighborListShapes, NorAnyOfAFewFastGrains) {
  const Shape shape = GetParam();
  Config c = grain_config();
  c.size = shape.size;
  c.grains->boundary_x = shape.x;
  c.grains->boundary_z = shape.z;
  const Real lx = shape.x == GrainBoundaryX::periodic ? c.size[0] : 0;
  const Real lz = shape.z == GrainBoundaryZ::periodic ? c.size[2] : 0;
  GrainState s = make_grain_state(random_grains(1200, c.size, 7), 2500);
  slow_down_most(s, 1e-3);
  NeighborList list(c, s.r_max);
  list.rebuild(s, false);
  EXPECT_EQ(listed_pairs(s), all_pairs(s, true, lx, lz));
  Real smallest = 1, largest = 0;
  const auto kin = host_copy(s.kin);
  for (int g = 0; g < s.n; ++g) {
    smallest = std::min(smallest, kin(g).skin), largest = std::max(largest, kin(g).skin);
  }
  EXPECT_NEAR(smallest, c.grains->skin / 2, 1e-3 * c.grains->skin);
  EXPECT_GT(largest, 1.2 * smallest);
  use_up_skins(s, 0.999);
  const PairSet listed = listed_pairs(s);
  for (const auto& pair : all_pairs(s, false, lx, lz)) EXPECT_TRUE(listed.count(pair));
}

// Among many grains some pairs lie two columns apart: one of theirs is fast.
TEST(NeighborList, FastGrainsMeetPartnersTwoColumnsAway) {
  Config c = grain_config();
  c.size = {0.003, 0.003, 0.003};
  GrainState s = make_grain_state(random_grains(5000, c.size, 5), 2500);
  slow_down_most(s, 1e-3);
  NeighborList list(c, s.r_max);
  list.rebuild(s, false);
  EXPECT_EQ(listed_pairs(s), all_pairs(s, true, 0, c.size[2]));
  const auto i = host_copy(s.list.i), j = host_copy(s.list.j);
  const auto kin = host_copy(s.kin);
  const Real column = 2 * s.r_max + 3 * c.grains->skin;
  int n_far = 0;
  for (int p = 0; p < s.list.n_pairs; ++p)
    n_far += std::abs(kin(i(p)).x.x - kin(j(p)).x.x) > column ? 1 : 0;
  EXPECT_GT(n_far, 100);
}

// However fast all are, a skin is on average at most half as wide again as at rest.
TEST(NeighborList, WhenAllAreFastNoneHasAWideSkin) {
  const Config c = grain_config();
  GrainState s = make_grain_state(random_grains(300, c.size, 11), 2500);
  NeighborList list(c, s.r_max);
  list.rebuild(s, true);
  const auto kin = host_copy(s.kin);
  Real mean = 0;
  for (int g = 0; g < s.n; ++g) mean += kin(g).skin / s.n;
  EXPECT_NEAR(mean, 1.5 * c.grains->skin / 2, 1e-5 * mean);
}

INSTANTIATE_TEST_SUITE_P(
    Boundaries, NeighborListShapes,
    ::testing::Values(
        Shape{GrainBoundaryX::exit, GrainBoundaryZ::periodic, {0.01, 0.004, 0.003}},
        Shape{GrainBoundaryX::periodic, GrainBoundaryZ::periodic, {0.0009, 0.03, 0.004}},
        Shape{GrainBoundaryX::wall, GrainBoundaryZ::wall, {0.0003, 0.02, 0.01}}));

TEST(NeighborList, HistoryFollowsItsPairThroughSorting) {
  Config c = grain_config();
  c.size = {0.003, 0.003, 0.003};
  GrainState s = make_grain_state(random_grains(500, c.size, 3), 2500);
  NeighborList list(c, s.r_max);
  list.with_rolling = list.with_force = true;
  list.rebuild(s, false);
  handle_marks(s, true);
  const PairSet before = listed_pairs(s);
  drift(s, 1e-4);  // order and some pairs change
  list.rebuild(s, false);
  EXPECT_EQ(handle_marks(s, false), 0);
  // Every pair that stayed is still marked.
  const auto touching = host_copy(s.list.touching);
  int kept = 0, marked = 0;
  for (const auto& pair : listed_pairs(s)) kept += before.contains(pair) ? 1 : 0;
  for (int p = 0; p < s.list.n_pairs; ++p) marked += touching(p);
  EXPECT_GT(kept, 100);
  EXPECT_EQ(marked, kept);
}

/// Memory whose bits mean nothing, as others leave it.
ScratchMemory idle_memory(const Grid& grid, int fields, std::vector<Field>& all) {
  while (static_cast<int>(all.size()) < fields) {
    all.emplace_back("test: idle", grid);
    Kokkos::deep_copy(all.back().storage, Kokkos::Experimental::quiet_NaN_v<Real>);
  }
  return ScratchMemory(all);
}

TEST(NeighborList, TakesIdleMemoryForTheSameListAndHistory) {
  Config c = grain_config();
  c.size = {0.003, 0.003, 0.003};
  Grid grid;
  grid.nx = grid.ny = 18, grid.nz = 30;  // 12,800 numbers a field
  for (const int fields : {0, 1, 12}) {  // none, not enough, plenty
    GrainState s = make_grain_state(random_grains(500, c.size, 3), 2500);
    NeighborList list(c, s.r_max);
    list.with_rolling = list.with_force = true;
    std::vector<Field> idle;
    list.use_scratch(idle_memory(grid, fields, idle));
    for (int round = 0; round < 4; ++round) {
      list.rebuild(s, false);
      EXPECT_EQ(listed_pairs(s), all_pairs(s, true, 0, c.size[2]));
      EXPECT_EQ(round > 0 ? handle_marks(s, false) : 0, 0);
      handle_marks(s, true);
      for (const Field& field : idle) {
        Kokkos::deep_copy(field.storage, Kokkos::Experimental::quiet_NaN_v<Real>);
      }
      drift(s, 1e-4);
    }
  }
}

TEST(NeighborList, IdleMemoryIsGivenOutOnce) {
  Grid grid;
  grid.nx = grid.ny = grid.nz = 6;  // 512 numbers a field: 4096 bytes
  std::vector<Field> fields;
  ScratchMemory idle = idle_memory(grid, 2, fields);
  const auto* const first = reinterpret_cast<const std::byte*>(fields[0].storage.data());
  const auto place = [&](const auto& view) {
    return reinterpret_cast<const std::byte*>(view.data()) - first;
  };
  const auto a = idle.take<int>(3);
  EXPECT_EQ(place(a), 0);
  EXPECT_EQ(a.extent(0), 3u);
  EXPECT_EQ(place(idle.take<std::int64_t>(504)), 64) << "on the next boundary, to the end";
  const auto b = idle.take<Vec3>(1);
  EXPECT_EQ(static_cast<const void*>(b.data()), fields[1].storage.data());
  EXPECT_EQ(idle.take<Real>(505).extent(0), 0u) << "more than is left";
  idle.free_all();
  EXPECT_EQ(place(idle.take<Real>(512)), 0);
  EXPECT_EQ(idle.take<Real>(513).extent(0), 0u) << "no field is that large";
}

TEST(NeighborList, IdleFieldsThatFollowEachOtherAreOnePiece) {
  const Kokkos::View<Real****, Kokkos::LayoutLeft> all("test: idle", 8, 8, 8, 3);
  const auto field = [&](int c) {
    return Field(Kokkos::subview(all, Kokkos::ALL, Kokkos::ALL, Kokkos::ALL, c));
  };
  ScratchMemory idle({field(0), field(1), field(2)});
  EXPECT_EQ(idle.take<Real>(3 * 512 + 1).extent(0), 0u);
  EXPECT_EQ(idle.take<Real>(3 * 512).data(), all.data());
}

TEST(NeighborList, DropsAndCountsWhatLeft) {
  const Config c = grain_config();
  GrainState s = make_grain_state(random_grains(300, c.size, 11), 2500);
  NeighborList list(c, s.r_max);
  list.rebuild(s, true);
  push_out(s);
  list.rebuild(s, false);
  EXPECT_EQ(s.n, 300) << "only a rebuild that may drop does";
  list.rebuild(s, true);
  EXPECT_EQ(s.n, 270);
  EXPECT_EQ(s.n_left, 30);
  const auto left = host_copy(s.id);
  for (int g = 0; g < s.n; ++g) EXPECT_NE(left(g) % 10, 0);
}

TEST(NeighborList, NamesTheGrainWhosePositionIsNotFinite) {
  const Config c = grain_config();
  GrainState s = make_grain_state(random_grains(20, c.size, 5), 2500);
  NeighborList list(c, s.r_max);
  list.rebuild(s, true);
  spoil(s, 13);
  try {
    list.rebuild(s, false);
    FAIL();
  } catch (const std::runtime_error& problem) {
    EXPECT_NE(std::string(problem.what()).find("grain 13"), std::string::npos) << problem.what();
  }
}

TEST(NeighborList, RefusesAPeriodicDomainNarrowerThanThreeRanges) {
  Config c = grain_config();
  c.size[2] = 7e-4;
  EXPECT_THROW(NeighborList(c, 1.25e-4), std::runtime_error);
}

}  // namespace
}  // namespace barchan
