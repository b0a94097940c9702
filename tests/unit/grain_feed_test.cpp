// Grains that come in, those that leave a window that follows its dune, and their accounts.
#include "src/grains/grain_feed.hpp"
#include "kernels/grains/sphere.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "src/initial/initial_state.hpp"
#include "src/initial/overlaps.hpp"
#include "src/restart/feed_state_file.hpp"
#include "src/run/run_accounts.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr Real kSmall = 1.5e-4, kLarge = 2.5e-4;  // diameters [m]

/// Box of still fluid with an outlet, 12 x 3 x 4 mm; grains sink.
Config fed_case(FeedAmount amount, double rate) {
  Config c = test::still_water({0.012, 0.003, 0.004});
  c.grains->boundary_x = GrainBoundaryX::exit;
  c.grains->gravity = {0, -9.81, 0};
  c.grains->feed = FeedConfig{.amount = amount, .rate = rate, .x = 1e-3};
  return c;
}

/// A row of small grains and one large one in four, far downstream.
InitialGrains some_grains(int n, double u_x = 0) {
  InitialGrains grains;
  for (int g = 0; g < n; ++g) {
    const double d = g % 4 == 0 ? kLarge : kSmall;
    test::add_grain(grains, d, {0.006 + 3e-4 * (g % 16), d / 2 + 3e-4 * (g / 16), 0.002},
                    {u_x, 0, 0});
  }
  return grains;
}

/// Grains of all ids with their diameters; no id is there twice.
std::map<std::int64_t, Real> diameters(const GrainState& grains) {
  const auto kin = host_copy(grains.kin);
  const auto id = host_copy(grains.id);
  std::map<std::int64_t, Real> found;
  for (int g = 0; g < grains.n; ++g) {
    EXPECT_TRUE(found.emplace(id(g), 2 * kin(g).r).second) << "twice: " << id(g);
  }
  return found;
}

/// Smallest distance of two grains over the sum of their radii.
Real smallest_gap(const GrainState& grains) {
  const auto kin = host_copy(grains.kin);
  Real least = 1e9;
  for (int a = 0; a < grains.n; ++a) {
    for (int b = 0; b < a; ++b)
      least = std::min(least, norm(kin(a).x - kin(b).x) / (kin(a).r + kin(b).r));
  }
  return least;
}

void carry_on(const GrainState& grains, Real distance) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: carry on", grains.n, KOKKOS_LAMBDA(int g) { kin(g).x.x += distance; });
}

TEST(GrainFeed, BringsInTheGivenRateFromItsStartOn) {
  Config c = fed_case(FeedAmount::given, 1000);
  c.grains->feed->start = 0.005;
  c.grains->gravity = {0, 0, 0};
  CoupledRun run(c, some_grains(8));
  const GrainState& grains = *run.state.grains;
  run.advance(20);
  EXPECT_EQ(grains.feed.n_fed, 0) << "at 5 ms";
  run.advance(60);
  // 15 ms at 1,000 in a second, in a line that holds at most 4 mm / 0.15 mm of them.
  EXPECT_EQ(grains.feed.n_fed + n_waiting(grains.feed), 15);
  EXPECT_GE(grains.feed.n_fed, 8);
  EXPECT_EQ(grains.n, 8 + grains.feed.n_fed);
  EXPECT_GE(smallest_gap(grains), 1) << "nothing moves here";
  const auto found = diameters(grains);
  EXPECT_EQ(found.rbegin()->first, 8 + grains.feed.n_fed)
      << "numbers go on from those at the start";
  EXPECT_EQ(static_cast<std::int64_t>(found.size()), 8 + grains.feed.n_fed);
}

TEST(GrainFeed, PutsThemWhereItIsTold) {
  Config c = fed_case(FeedAmount::given, 1000);
  c.grains->gravity = {0, 0, 0};
  c.grains->feed->x = 2e-3;
  c.grains->feed->across = {1e-3, 2e-3};
  c.grains->feed->height = 5e-4;
  CoupledRun run(c, some_grains(8));
  run.advance(16);
  const auto kin = host_copy(run.state.grains->kin);
  const auto id = host_copy(run.state.grains->id);
  std::set<Real> across;
  for (int g = 0; g < run.state.grains->n; ++g) {
    if (id(g) <= 8) continue;
    EXPECT_DOUBLE_EQ(kin(g).x.x - kin(g).r, 2e-3);
    EXPECT_DOUBLE_EQ(kin(g).x.y - kin(g).r, 5e-4);
    EXPECT_GE(kin(g).x.z, 1e-3);
    EXPECT_LE(kin(g).x.z, 2e-3);
    EXPECT_EQ(norm(kin(g).u), 0);
    EXPECT_DOUBLE_EQ(kin(g).m, 2500 * sphere_volume(kin(g).r));
    across.insert(kin(g).x.z);
  }
  EXPECT_GE(across.size(), 3u);
}

/// A grain that lies still keeps its place free of a second one.
TEST(GrainFeed, OthersWaitWhileThePlaceIsTaken) {
  Config c = fed_case(FeedAmount::given, 4000);
  c.grains->gravity = {0, 0, 0};
  c.grains->feed->across = {2e-3, 2.0001e-3};
  CoupledRun run(c, some_grains(8));
  run.advance(40);
  EXPECT_EQ(run.state.grains->feed.n_fed, 1);
  EXPECT_EQ(n_waiting(run.state.grains->feed), 39);
  carry_on(*run.state.grains, 3e-4);
  run.advance(1);
  EXPECT_EQ(run.state.grains->feed.n_fed, 2);
}

/// 3/4 of the grains at the start are small: of n that come in so many are, but for four times
/// sqrt(n 3/16).
TEST(GrainFeed, SizesAreThoseOfTheGrainsAtTheStart) {
  Config c = fed_case(FeedAmount::given, 4000);
  c.grains->gravity = {0, 0, 0};
  CoupledRun run(c, some_grains(8));
  std::map<std::int64_t, Real> seen;
  for (int step = 0; step < 400; ++step) {
    run.advance(1);
    seen.merge(diameters(*run.state.grains));
    carry_on(*run.state.grains, 4e-4);
  }
  const GrainState& grains = *run.state.grains;
  EXPECT_EQ(grains.feed.n_fed, 400);
  EXPECT_EQ(grains.n + grains.n_left, 408);
  int small = 0;
  for (const auto& [id, d] : seen) small += id > 8 && d == kSmall ? 1 : 0;
  EXPECT_NEAR(small, 300, 4 * std::sqrt(400 * 3.0 / 16));
}

/// All that leave come back, each with its size and a new number.
TEST(GrainFeed, AsManyComeBackAsLeave) {
  Config c = fed_case(FeedAmount::as_lost, 0);
  c.grains->gravity = {0, 0, 0};
  CoupledRun run(c, some_grains(32));
  const auto before = diameters(*run.state.grains);
  int left_at_once = 0;
  for (int step = 0; step < 200; ++step) {
    carry_on(*run.state.grains, 2e-4);
    const std::int64_t left = run.state.grains->n_left;
    run.advance(1);
    left_at_once += run.state.grains->n_left > left + 1 ? 1 : 0;
    const GrainState& s = *run.state.grains;
    ASSERT_EQ(s.n + s.n_left, 32 + s.feed.n_fed);
    ASSERT_EQ(s.feed.n_fed + n_waiting(s.feed), s.n_left);
  }
  EXPECT_GT(left_at_once, 0);
  EXPECT_GT(run.state.grains->n_left, 64) << "each has left more than once";
  std::multiset<Real> sizes, sizes_before;
  for (const auto& [id, d] : before) sizes_before.insert(d);
  for (const auto& [id, d] : diameters(*run.state.grains)) {
    EXPECT_GT(id, 32);
    sizes.insert(d);
  }
  for (const GrainBody& body : run.state.grains->feed.waiting) sizes.insert(2 * body.r);
  EXPECT_EQ(sizes, sizes_before);
}

/// Numbers of grains that have left are not given again.
TEST(GrainFeed, NumbersGoOnFromTheLastThatWasGiven) {
  Config c = fed_case(FeedAmount::given, 4000);
  InitialGrains few = some_grains(8);
  few.last_id = 50;
  CoupledRun run(c, few);
  run.advance(1);
  ASSERT_EQ(run.state.grains->feed.n_fed, 1);
  EXPECT_TRUE(diameters(*run.state.grains).contains(51));
  EXPECT_EQ(last_id(*run.state.grains), 51);
}

TEST(GrainFeed, RefusesNumbersThatLeaveNoneFree) {
  const Config c = fed_case(FeedAmount::given, 4000);
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 2;
  const auto said = [&](const Config& config, std::int64_t last) {
    return message_of([&] { check_free_ids(config, last, "heap.csv"); });
  };
  EXPECT_EQ(said(c, most), "");
  EXPECT_EQ(said(c, most + 1),
            "heap.csv: a grain has the id 4611686018427387904: with [grains.feed] it must be at "
            "most 4611686018427387903, for grains that come in have the ids after it");
  Config unfed = c;
  unfed.grains->feed.reset();
  EXPECT_EQ(said(unfed, most + 1), "");
}

/// State of a run that all grains had left before its feed began: the feed has no bodies to choose
/// from, and gives back what leaves.
TEST(GrainFeed, AFeedWithoutBodiesComesBackFromItsRestartFile) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder.path(), 5, {});
  FeedState feed;
  feed.next_id = 9;
  feed.waiting = {{1e-4, 1e-9, 0}};
  save_feed(writer, feed);
  const FeedState back = load_feed(CheckpointReader(writer.commit(1)));
  EXPECT_EQ(back.next_id, 9);
  EXPECT_EQ(back.waiting.size(), 1u);
  EXPECT_TRUE(back.bodies.empty());
}

/// A box across the whole width at the place where grains come in, or with a gap beside it.
TEST(GrainFeed, IsRefusedWhereABodyTakesAllItsPlaces) {
  Config c = fed_case(FeedAmount::given, 1000);
  c.bodies = {{.name = "step",
               .shape = BodyShape::of<shapes::Box>(),
               .centre = {1e-3, 2e-3},
               .height = 1e-3,
               .size = {1e-3, 4e-3}}};
  const auto said = [&] { return message_of([&] { check_feed_places(c, {kSmall, kLarge}); }); };
  EXPECT_NE(said().find("no grain could come in: all across the stream a body is in its place"),
            std::string::npos)
      << said();
  c.bodies[0].size[1] = 3.6e-3;  // it leaves 0.2 mm on each side: enough for the small ones
  EXPECT_EQ(said(), "");
  c.grains->feed->across = {1e-3, 3e-3};
  EXPECT_NE(said(), "");
  c.grains->feed->height = 1e-3;
  EXPECT_EQ(said(), "") << "on top of it";
}

TEST(GrainFeed, ThatBringsInNothingIsTold) {
  Config c = fed_case(FeedAmount::given, 4000);
  c.grains->gravity = {0, 0, 0};
  c.grains->feed->across = {2e-3, 2.0001e-3};
  InitialGrains grains = some_grains(8);
  test::add_grain(grains, kLarge, {1e-3 + kLarge / 2, kLarge / 2, 2e-3});
  SystemState state;
  state.grains = make_grain_state(grains, 2500);
  RunState run(c, nullptr, std::move(state));
  EXPECT_EQ(unfed_grains(run), "");
  for (int step = 0; step < 10; ++step) run.advance();
  EXPECT_NE(unfed_grains(run).find("has brought in no grain so far: 10 wait"), std::string::npos)
      << unfed_grains(run);
  carry_on(*run.state.grains, 1e-3);
  run.advance();
  EXPECT_EQ(unfed_grains(run), "");
}

GrainKinematics grain_of(const GrainState& grains, std::int64_t id) {
  const auto kin = host_copy(grains.kin);
  const auto ids = host_copy(grains.id);
  for (int g = 0; g < grains.n; ++g) {
    if (ids(g) == id) return kin(g);
  }
  throw std::out_of_range("no grain " + std::to_string(id));
}

/// The entries of a new grain begin as those of a new run.
TEST(GrainFeed, ANewGrainFallsLikeOneThatWasThereFromTheStart) {
  Config c = test::still_water({0.012, 0.003, 0.004});
  c.grains->gravity = {0, -9.81, 0};
  c.grains->feed = FeedConfig{.rate = 1.001 / c.time.fluid_step, .x = 1e-3, .height = 2e-3};
  InitialGrains grains;
  test::add_grain(grains, kSmall, {0.009, kSmall / 2, 0.002});
  CoupledRun fed(c, grains);
  fed.advance(1);
  ASSERT_EQ(fed.state.grains->feed.n_fed, 1);
  const Vec3 at = grain_of(*fed.state.grains, 2).x;
  test::add_grain(grains, kSmall, at);
  c.grains->feed.reset();
  CoupledRun placed(c, grains);
  fed.advance(20);
  placed.advance(20);
  const GrainKinematics a = grain_of(*fed.state.grains, 2), b = grain_of(*placed.state.grains, 2);
  EXPECT_LT(b.x.y, at.y - 1e-5) << "it is meant to fall";
  EXPECT_DOUBLE_EQ(a.x.y, b.x.y);
  EXPECT_DOUBLE_EQ(a.u.y, b.u.y);
}

/// Grains within a cell of the edge leave, on both sides of it and across the ends of the box.
TEST(FollowingWindow, GrainsLeaveAtTheEdgeOfTheWindowAlone) {
  Config c = test::water_box({20, 4, 4}, {0.02, 0.003, 0.004});
  c.grains->boundary_x = GrainBoundaryX::follow;
  InitialGrains grains;
  for (int g = 0; g < 40; ++g) test::add_grain(grains, 2e-4, {2.5e-4 + 5e-4 * g, 1e-3, 2e-3});
  CoupledRun run(c, grains);
  run.advance(2);
  EXPECT_EQ(run.state.grains->n, 40) << "before the edge has a place";
  run.state.grains->window_edge = 1.99e-2;
  run.advance(1);
  // Strip from 18.9 to 20 and from 0 to 0.9 mm, centres at 0.25, 0.75, ... 19.75.
  const auto left = diameters(*run.state.grains);
  for (const int id : {1, 2, 39, 40}) EXPECT_FALSE(left.contains(id)) << id;
  for (const int id : {3, 37}) EXPECT_TRUE(left.contains(id)) << id;
  EXPECT_EQ(run.state.grains->n_left, 4);
}

/// A grain that goes beyond one end, far from the edge, comes in at the other.
TEST(FollowingWindow, IsPeriodicElsewhere) {
  Config c = test::water_box({20, 4, 4}, {0.02, 0.003, 0.004});
  c.grains->boundary_x = GrainBoundaryX::follow;
  InitialGrains grains;
  test::add_grain(grains, 2e-4, {1.99e-2, 1e-3, 2e-3}, {0.4, 0, 0});
  CoupledRun run(c, grains);
  run.state.grains->window_edge = 1e-2;
  run.advance(8);
  run.step.neighbor_list()->rebuild(*run.state.grains, false);
  ASSERT_EQ(run.state.grains->n, 1);
  EXPECT_LT(grain_of(*run.state.grains, 1).x.x, 2e-3);
}

}  // namespace
}  // namespace barchan
