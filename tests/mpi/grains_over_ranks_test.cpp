// Grains over ranks against the same grains on one rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/grains/grain_feed.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/shared_grains.hpp"

namespace barchan {
namespace {

using test::by_id;
using test::from_all_ranks;
using test::GrainBench;
using test::numbers_of;
using test::SharedGrains;

int n_ranks() { return rank_count(MPI_COMM_WORLD); }

/// True on one rank: for a single line of output, however many ranks there are.
bool is_first() { return rank_of(MPI_COMM_WORLD) == 0; }

Config box(std::array<double, 3> size) {
  Config c = test::grain_config();
  c.size = size;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  c.grains->material.rolling_friction = 0.1;
  c.grains->rolling_model = RollingModel::of<Epsd2>();
  return c;
}

/// Pairs of a list by ids and how many of their grains are owned; or those in contact alone.
std::vector<double> pairs_of(const GrainState& s, bool touching_only = false) {
  const auto i = host_copy(s.list.i), j = host_copy(s.list.j);
  const auto touching = host_copy(s.list.touching);
  const auto id = host_copy(s.id);
  std::vector<double> pairs;
  for (int p = 0; p < s.list.n_pairs; ++p) {
    if (touching_only && !touching(p)) continue;
    const std::int64_t a = std::min(id(i(p)), id(j(p))), b = std::max(id(i(p)), id(j(p)));
    pairs.push_back(static_cast<double>(a));
    pairs.push_back(static_cast<double>(b));
    pairs.push_back((i(p) < s.n) + (j(p) < s.n));
  }
  return pairs;
}
/// Grains that are owned where the pair is listed, over all lists: two for every pair.
std::map<std::pair<double, double>, int> owned_in(const std::vector<double>& pairs) {
  std::map<std::pair<double, double>, int> owned;
  for (std::size_t p = 0; p < pairs.size(); p += 3)
    owned[{pairs[p], pairs[p + 1]}] += static_cast<int>(pairs[p + 2]);
  return owned;
}

TEST(GrainsOverRanks, PairsAreThoseOfOneRank) {
  for (const std::array<double, 3> size :
       {std::array<double, 3>{0.01, 0.003, 0.004}, {0.0011, 0.004, 0.02}}) {
    const Config c = box(size);
    const SharedGrains s(c, test::random_grains(4000, size, 4));
    const auto whole = owned_in(pairs_of(s.whole.state));
    const auto shared = owned_in(from_all_ranks(pairs_of(s.shared.state)));
    ASSERT_GT(whole.size(), 1000u);
    EXPECT_EQ(whole, shared);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, s.shared.state.n), 4000);
  }
}

// A few fast grains have partners two columns away, and so on ranks that own no column beside
// theirs.
TEST(GrainsOverRanks, PairsOfFastGrainsAreThoseOfOneRank) {
  const std::array<double, 3> size{0.003, 0.003, 0.003};
  InitialGrains grains = test::random_grains(5000, size, 5);
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (g % 20 != 0) grains.u[g] = 1e-3 * grains.u[g];
  const SharedGrains s(box(size), grains);
  const auto whole = owned_in(pairs_of(s.whole.state));
  ASSERT_GT(whole.size(), 10000u);
  EXPECT_EQ(whole, owned_in(from_all_ranks(pairs_of(s.shared.state))));
}

TEST(GrainsOverRanks, OneGrainStepAsOnOneRank) {
  Config c = box({0.008, 0.006, 0.005});
  c.grains->floor = GrainFloor::glued;
  c.grains->floor_diameter = 2e-4;
  SharedGrains s(c, test::lattice_packing(6000, c.size, 0.5));
  s.advance(200, 1e-6);  // into contact, the history of which is then there
  s.advance(1, 1e-6);
  const auto off = s.off();
  // Bits may differ: a grain's contacts are added in the order of its rank's rows.
  for (const double difference : off) EXPECT_LT(difference, 1e-13);
  const ContactSummary a = s.whole.solver.contacts(s.whole.state),
                       b = s.shared.solver.contacts(s.shared.state);
  EXPECT_GT(a.n_contacts, 500);
  EXPECT_EQ(a.n_contacts, b.n_contacts);
  EXPECT_NEAR(a.max_overlap / b.max_overlap, 1, 1e-10);
  if (is_first())
    std::printf("[ measured ] %d ranks: x %.1e, u %.1e, omega %.1e, force %.1e, torque %.1e\n",
                n_ranks(), off[0], off[1], off[2], off[3], off[4]);
}

/// Grains that fly through each other and through the periodic sides, with marks for histories.
TEST(GrainsOverRanks, TenThousandMigrationsLoseNothing) {
  const Config c = box({0.006, 0.003, 0.005});
  InitialGrains grains = test::random_grains(3000, c.size, 5);
  for (Vec3& u : grains.u) u.y = 0;  // there is no floor
  GrainState whole = make_grain_state(grains, 2500);
  GrainState shared = make_grain_state(grains, 2500, MPI_COMM_WORLD);
  NeighborList whole_list(c, whole.r_max), shared_list(c, shared.r_max, MPI_COMM_WORLD);
  for (NeighborList* list : {&whole_list, &shared_list})
    list->with_rolling = list->with_force = true;
  whole_list.rebuild(whole, false);
  shared_list.rebuild(shared, false);
  std::int64_t migrated = 0, contacts = 0;
  int round = 0;
  for (; round < 400 && (round < 20 || (n_ranks() > 1 && migrated < 10000)); ++round) {
    test::handle_marks(whole, true);
    test::handle_marks(shared, true);
    test::drift(whole, 6e-5);
    test::drift(shared, 6e-5);
    whole_list.rebuild(whole, false);
    shared_list.rebuild(shared, false);
    ASSERT_EQ(test::handle_marks(shared, false), 0) << "history of another pair, round " << round;
    const auto kept = owned_in(pairs_of(whole, true));
    ASSERT_EQ(kept, owned_in(from_all_ranks(pairs_of(shared, true)))) << "round " << round;
    contacts += static_cast<std::int64_t>(kept.size());
    migrated = sum_over(MPI_COMM_WORLD, shared_list.n_migrated());
  }
  EXPECT_GT(contacts, 10000);
  EXPECT_TRUE(n_ranks() == 1 || migrated >= 10000) << migrated;
  // Every grain is there once, with the velocity and mass it began with, where one rank has it.
  const auto a = by_id(numbers_of(whole)), b = by_id(from_all_ranks(numbers_of(shared)));
  EXPECT_EQ(a, b);
  if (is_first())
    std::printf("[ measured ] %d ranks: %lld migrations in %d rebuilds, %lld histories carried\n",
                n_ranks(), static_cast<long long>(migrated), round,
                static_cast<long long>(contacts));
}

/// Differences beyond 1e-9 are no larger than those of one rank from itself after all were moved by
/// a bit.
TEST(GrainsOverRanks, TheExitDropsWhatItDropsOnOneRank) {
  Config c = box({0.004, 0.004, 0.005});
  c.grains->boundary_x = GrainBoundaryX::exit;
  const InitialGrains grains = test::lattice_packing(2000, c.size, 0.8);
  SharedGrains s(c, grains);
  GrainBench moved(c, grains);
  test::move_by_the_last_bit(moved.state, 0, moved.state.n);
  for (int step = 0; step < 20; ++step) {
    s.advance(25, 4e-6);
    moved.advance(25, 4e-6);
    moved.solver.remove_left(moved.state);
  }
  EXPECT_LT(s.whole.state.n, 1900);
  EXPECT_EQ(sum_over(MPI_COMM_WORLD, s.shared.state.n), s.whole.state.n);
  EXPECT_EQ(sum_over(MPI_COMM_WORLD, s.shared.state.n_left), s.whole.state.n_left);
  const auto off = s.off();
  const auto chaos =
      test::differences(by_id(numbers_of(s.whole.state)), by_id(numbers_of(moved.state)));
  for (std::size_t q = 0; q < off.size(); ++q) EXPECT_LT(off[q], std::max(1e-9, chaos[q]));
  if (is_first())
    std::printf("[ measured ] %d ranks: u %.1e; all moved by a bit: %.1e\n", n_ranks(), off[1],
                chaos[1]);
}

/// The feed brings the same grains in at the same places, and those that left with the same sizes.
TEST(GrainsOverRanks, AFeedBringsInWhatItBringsInOnOneRank) {
  for (const FeedAmount amount : {FeedAmount::given, FeedAmount::as_lost}) {
    Config c = box({0.004, 0.004, 0.005});
    c.grains->boundary_x = GrainBoundaryX::exit;
    c.grains->feed = FeedConfig{.amount = amount, .rate = 2e4, .x = 5e-5, .height = 3e-3};
    c.time.fluid_step = 1e-4;
    SharedGrains s(c, test::lattice_packing(2000, c.size, 0.8));
    GrainFeed of_whole(c), of_shared(c);
    for (int step = 0; step < 20; ++step) {
      s.whole.advance(25, 4e-6);
      s.shared.advance(25, 4e-6);
      of_whole.advance(s.whole.state, s.whole.solver.list());
      of_shared.advance(s.shared.state, s.shared.solver.list());
    }
    const FeedState &a = s.whole.state.feed, &b = s.shared.state.feed;
    EXPECT_GT(a.n_fed, 15);  // a row across the channel has room for some 20
    EXPECT_EQ(a.n_fed, b.n_fed);
    EXPECT_EQ(a.n_tries, b.n_tries);
    EXPECT_EQ(a.waiting, b.waiting);
    EXPECT_EQ(a.bodies, b.bodies);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, s.shared.state.n), s.whole.state.n);
    const auto off = s.off();  // infinite if the numbers are not the same
    EXPECT_LT(off[0], 1e-6);
    if (is_first())
      std::printf("[ measured ] %d ranks: %lld fed, x %.1e\n", n_ranks(),
                  static_cast<long long>(a.n_fed), off[0]);
  }
}

/// Walls that any grain touches now, a bit each.
unsigned walls_touched(const GrainState& grains) {
  const auto touching = host_copy(grains.wall_touching);
  unsigned all = 0;
  for (int g = 0; g < grains.n; ++g) all |= touching(g);
  return all;
}

/// Grains that fly about between a glued floor and five walls. Each collision makes a difference
/// larger: ranks differ from one rank by no more, and no sooner, than that one from itself after
/// all grains were moved by the last bit of their position.
TEST(GrainsOverRanks, EightWallsAsOnOneRankUntilChaos) {
  Config c = box({0.003, 0.0027, 0.003});
  c.grains->boundary_x = GrainBoundaryX::wall;
  c.grains->boundary_z = GrainBoundaryZ::wall;
  c.grains->floor = GrainFloor::glued;
  c.grains->floor_diameter = 2e-4;
  const InitialGrains grains = test::lattice_packing(500, c.size, 1.0);
  SharedGrains s(c, grains);
  GrainBench moved(c, grains);
  test::move_by_the_last_bit(moved.state, 0, moved.state.n);
  unsigned touched = 0;
  for (int round = 1; round <= 20; ++round) {
    s.advance(100, 4e-6);
    moved.advance(100, 4e-6);
    touched |= walls_touched(s.whole.state);
    const double off = s.off()[0];
    const double chaos =
        test::differences(by_id(numbers_of(s.whole.state)), by_id(numbers_of(moved.state)))[0];
    EXPECT_LT(off, chaos) << "round " << round;
    if (round % 5 == 0 && is_first())
      std::printf("[ measured ] %d ranks, %.1f ms: x %.1e; all moved by a bit: %.1e\n", n_ranks(),
                  0.4 * round, off, chaos);
  }
  EXPECT_EQ(touched, 0xffu) << "a wall that no grain touches";
}

void move_the_left_ones(const GrainState& grains) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: move", grains.n, KOKKOS_LAMBDA(int g) {
        if (kin(g).x.x < 0.003) kin(g).x.x += 0.012;
      });
}

/// A heap beside an empty floor.
TEST(GrainsOverRanks, CutsGiveEqualWorkAndFollowTheGrains) {
  Config c = box({0.02, 0.01, 0.004});
  c.grains->boundary_x = GrainBoundaryX::exit;
  InitialGrains grains = test::lattice_packing(6000, {0.006, 0.01, 0.004}, 0.01);
  GrainBench s(c, grains, MPI_COMM_WORLD);
  if (n_ranks() == 1) return;
  const GrainPartition& cuts = *s.solver.list().partition();
  EXPECT_LT(cuts.imbalance(), 1.15);
  const Real mean = 6000.0 / n_ranks();
  EXPECT_LT(max_over(MPI_COMM_WORLD, s.state.n), 1.15 * mean);
  // All that lies left of the middle goes far to the right: one or two ranks have it all.
  move_the_left_ones(s.state);
  s.solver.list().rebuild(s.state, false);  // they go to the owners of the places ...
  s.solver.list().rebuild(s.state, false);  // ... who then have too much to do
  EXPECT_GT(cuts.imbalance_before(), 1.1);
  EXPECT_LT(cuts.imbalance(), 1.15);
  EXPECT_LT(max_over(MPI_COMM_WORLD, s.state.n), 1.2 * mean);
  if (is_first())
    std::printf("[ measured ] %d ranks: imbalance %.3f, cut again: %.3f\n", n_ranks(),
                cuts.imbalance_before(), cuts.imbalance());
}

}  // namespace
}  // namespace barchan
