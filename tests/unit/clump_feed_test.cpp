// Clumps that come in, and clumps that leave and come back.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "kernels/grains/sphere.hpp"
#include "src/app/memory.hpp"
#include "src/case/grain_checks.hpp"
#include "src/coupling/ledger.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/overlaps.hpp"
#include "src/restart/feed_state_file.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kSmall = 1.5e-4, kLarge = 2.5e-4;  // diameters [m]
constexpr Real kX = 1e-3, kHeight = 5e-4;         // of the feed [m]

/// Box of still water with an outlet, 12 x 3 x 4 mm, of cubes and spheres; without weight.
Config fed_case(FeedAmount amount, double rate) {
  Config c = still_water({0.012, 0.003, 0.004});
  c.grains->boundary_x = GrainBoundaryX::exit;
  c.grains->kinds.resize(2);
  c.grains->kinds[0].name = "cube", c.grains->kinds[1].name = "sphere";
  c.grains->kinds[1].density = 4000;
  for (KindConfig& kind : c.grains->kinds) kind.material = c.grains->material;
  c.grains->kinds[0].shape = {.shape = GrainShape::clump, .clump = NamedClump::cube};
  c.grains->feed =
      FeedConfig{.amount = amount, .rate = rate, .x = kX, .height = kHeight, .seed = 7};
  return c;
}

/// Grains far downstream: two cubes of three, one large grain in four.
InitialGrains some_grains(int n) {
  InitialGrains grains;
  for (int g = 0; g < n; ++g) {
    add_grain(grains, g % 4 == 0 ? kLarge : kSmall,
              {0.006 + 4e-4 * (g % 12), 1e-3 + 4e-4 * (g / 12), 0.002});
    grains.kind.push_back(g % 3 == 2 ? 1 : 0);
  }
  return grains;
}

CoupledRun run_of(const Config& c, const InitialGrains& grains) {
  SystemState state;
  state.grains = make_grain_state(spheres_at_start(grains, c), densities_of(*c.grains));
  return {c, std::move(state)};
}

/// Whole grains by their numbers; none is there twice.
std::map<std::int64_t, GrainKinematics> whole_by_number(const GrainState& grains) {
  const GrainState whole = whole_grains(grains);
  const auto kin = host_copy(whole.kin);
  const auto id = host_copy(whole.id);
  std::map<std::int64_t, GrainKinematics> found;
  for (int g = 0; g < whole.n; ++g) {
    EXPECT_TRUE(found.emplace(id(g), kin(g)).second) << "twice: " << id(g);
  }
  return found;
}

void carry_on(const GrainState& grains, Real distance) {
  const auto kin = grains.kin;
  const auto clump = grains.clump;
  Kokkos::parallel_for(
      "test: carry on", grains.n, KOKKOS_LAMBDA(int g) {
        kin(g).x.x += distance;
        clump(g).x.x += distance;
      });
}

/// Smallest distance of spheres of different clumps over the sum of their radii.
Real smallest_gap(const GrainState& grains) {
  const auto kin = host_copy(grains.kin);
  const auto id = host_copy(grains.id);
  Real least = 1e9;
  for (int a = 0; a < grains.n; ++a)
    for (int b = 0; b < a; ++b)
      if (clump_of_id(id(a)) != clump_of_id(id(b)))
        least = std::min(least, norm(kin(a).x - kin(b).x) / (kin(a).r + kin(b).r));
  return least;
}

TEST(FedClumps, ComeInAsAWholeAndTurnedByTheirNumbers) {
  const Config c = fed_case(FeedAmount::given, 2000);
  CoupledRun run = run_of(c, some_grains(9));
  for (int step = 0; step < 60; ++step) run.advance();
  const GrainState& s = *run.state.grains;
  ASSERT_GE(s.feed.n_fed, 8);
  EXPECT_EQ(s.feed.n_fed + n_waiting(s.feed), 30);
  EXPECT_EQ(grain_count(s), 9 + s.feed.n_fed);
  EXPECT_EQ(last_id(s), 9 + s.feed.n_fed);
  EXPECT_GE(smallest_gap(s), 1);
  // The same grains by the way of those at the start, with the seed of the feed.
  const auto whole = whole_by_number(s);
  const double width = width_of(c.grains->kinds[0].shape);
  const auto kind = host_copy(s.kind);
  const auto id = host_copy(s.id);
  std::map<std::int64_t, int> kind_of;
  for (int e = 0; e < s.n; ++e) kind_of[clump_of_id(id(e))] = kind(e);
  InitialGrains alike;
  int n_cubes = 0;
  for (const auto& [number, grain] : whole) {
    if (number <= 9) continue;
    const int k = kind_of[number];
    alike.add(number, 2 * grain.r, grain.x);
    alike.kind.push_back(static_cast<std::uint8_t>(k));
    n_cubes += k == 0 ? 1 : 0;
    EXPECT_TRUE(grain.r == kSmall / 2 || grain.r == kLarge / 2);
    EXPECT_DOUBLE_EQ(grain.m, (k == 0 ? 2500 : 4000) * sphere_volume(grain.r));
    EXPECT_DOUBLE_EQ(grain.x.x, kX + (k == 0 ? width : 1) * grain.r);
    EXPECT_DOUBLE_EQ(grain.x.y, kHeight + (k == 0 ? width : 1) * grain.r);
    EXPECT_EQ(norm(grain.u) + norm(grain.omega), 0);
  }
  EXPECT_GT(n_cubes, 3);
  EXPECT_LT(n_cubes, s.feed.n_fed);
  const InitialGrains spheres = as_spheres(alike, *c.grains, 7);
  const auto kin = host_copy(s.kin);
  std::map<std::int64_t, GrainKinematics> entry;
  for (int e = 0; e < s.n; ++e) entry[id(e)] = kin(e);
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    ASSERT_TRUE(entry.contains(spheres.id[k])) << spheres.id[k];
    const GrainKinematics& sphere = entry[spheres.id[k]];
    EXPECT_EQ(sphere.r, spheres.diameter[k] / 2);
    EXPECT_EQ(sphere.m, whole.at(clump_of_id(spheres.id[k])).m) << "each has that of its clump";
    EXPECT_NEAR(norm(run.step.grain_solver()->box().nearest_image(sphere.x - spheres.x[k])), 0,
                1e-17);
  }
}

/// A cube waits where a sphere of its volume would have room beside one that lies there.
TEST(FedClumps, WaitUntilTheSphereAroundThemHasRoom) {
  Config c = fed_case(FeedAmount::given, 4000);
  c.grains->feed->across = {2e-3, 2.0001e-3};
  InitialGrains cubes;
  for (int g = 0; g < 3; ++g) {
    add_grain(cubes, kLarge, {0.006 + 4e-4 * g, 1e-3, 0.002});
    cubes.kind.push_back(0);
  }
  // A sphere 1.1 d above where cubes come in: they are up to 1.4 d wide.
  const double around = width_of(c.grains->kinds[0].shape) * kLarge / 2;
  ASSERT_GT(around, 0.65 * kLarge);
  const auto n_fed = [&](Real apart) {
    InitialGrains grains = cubes;
    add_grain(grains, kLarge, {kX + around, kHeight + around + apart, 2e-3});
    grains.kind.push_back(1);
    CoupledRun run = run_of(c, grains);
    run.advance(1);
    const FeedState& feed = run.state.grains->feed;
    EXPECT_TRUE(feed.waiting.empty() || feed.waiting[0].kind == 0) << "it is a cube";
    return feed.n_fed;
  };
  EXPECT_EQ(n_fed(1.1 * kLarge), 0);
  EXPECT_EQ(n_fed(0.999 * (around + kLarge / 2)), 0);
  EXPECT_EQ(n_fed(1.001 * (around + kLarge / 2)), 1);
}

/// All that leave come back, each with its size and kind and a new number; a clump counts once.
TEST(FedClumps, AsManyComeBackAsLeave) {
  const Config c = fed_case(FeedAmount::as_lost, 0);
  CoupledRun run = run_of(c, some_grains(36));
  using Body = std::pair<Real, Real>;
  const auto bodies = [&] {
    std::multiset<Body> all;
    for (const auto& [number, grain] : whole_by_number(*run.state.grains))
      all.insert({grain.r, grain.m});
    for (const GrainBody& body : run.state.grains->feed.waiting) all.insert({body.r, body.m});
    return all;
  };
  const auto before = bodies();
  int left_at_once = 0;
  for (int step = 0; step < 120; ++step) {
    carry_on(*run.state.grains, 3e-4);
    const std::int64_t left = run.state.grains->n_left;
    run.advance(1);
    const GrainState& s = *run.state.grains;
    left_at_once += s.n_left > left + 1 ? 1 : 0;
    ASSERT_EQ(grain_count(s) + s.n_left, 36 + s.feed.n_fed);
    ASSERT_EQ(s.feed.n_fed + n_waiting(s.feed), s.n_left);
    ASSERT_NO_THROW(Ledger().close_step(ExchangeLedger(), s));
  }
  EXPECT_GT(left_at_once, 0);
  EXPECT_GT(run.state.grains->n_left, 72) << "each has left more than once";
  EXPECT_EQ(bodies(), before);
}

TEST(FedClumps, LedgerCountsEachClumpOnce) {
  const Config c = fed_case(FeedAmount::given, 1000);
  CoupledRun run = run_of(c, some_grains(9));
  GrainState grains = *run.state.grains;
  EXPECT_NO_THROW(Ledger().close_step(ExchangeLedger(), grains));
  ++grains.n_left;
  EXPECT_EQ(message_of([&] { Ledger().close_step(ExchangeLedger(), grains); }),
            "grains inside and left do not add up to those at the start and fed: 9 + 1 is not 9");
}

/// Bodies of a restart file are those of whole grains.
TEST(FedClumps, WaitInARestartFileAsWholeGrains) {
  Config c = fed_case(FeedAmount::given, 4000);
  c.grains->feed->across = {2e-3, 2.0001e-3};
  CoupledRun run = run_of(c, some_grains(9));
  run.advance(4);
  const FeedState& feed = run.state.grains->feed;
  EXPECT_EQ(feed.bodies.size(), 9u);
  EXPECT_EQ(feed.waiting.size(), 3u);
  for (const GrainBody& body : feed.bodies) {
    EXPECT_TRUE(body.r == kSmall / 2 || body.r == kLarge / 2);
    EXPECT_DOUBLE_EQ(body.m, (body.kind == 0 ? 2500 : 4000) * sphere_volume(body.r));
  }
  const TemporaryFolder folder;
  CheckpointWriter writer(folder.path(), 5, {});
  save_feed(writer, feed);
  const FeedState back = load_feed(CheckpointReader(writer.commit(1)));
  EXPECT_EQ(back.bodies, feed.bodies);
  EXPECT_EQ(back.waiting, feed.waiting);
}

TEST(FedClumps, NumbersStayBelowThoseOfSpheres) {
  Config c = fed_case(FeedAmount::given, 1000);
  constexpr std::int64_t most = kLargestNumber / 2;
  EXPECT_EQ(message_of([&] { check_free_ids(c, most, "heap.csv"); }), "");
  EXPECT_NE(message_of([&] { check_free_ids(c, most + 1, "heap.csv"); }), "");
  c.grains->kinds[0].shape = {};
  EXPECT_EQ(message_of([&] { check_free_ids(c, most + 1, "heap.csv"); }), "");
}

TEST(FedClumps, NeedAPlaceForTheSphereAroundThem) {
  Config c = fed_case(FeedAmount::given, 1000);
  const std::vector<SizeClass> sizes{{.diameter = kLarge, .count = 10, .kind = 0}};
  const double width = width_of(c.grains->kinds[0].shape) * kLarge;
  const auto said = [&](const std::string& key) {
    std::vector<std::string> all;
    for (const Finding& f : check_grain_sizes(c, sizes))
      if (f.keys.front() == key) all.push_back(f.message);
    return all;
  };
  c.grains->feed->height = c.size[1] - 1.001 * width;
  c.grains->feed->x = c.size[0] - 1.001 * width;
  EXPECT_TRUE(said("grains.feed.height").empty());
  EXPECT_TRUE(said("grains.feed.x").empty());
  c.grains->feed->height += 0.002 * width;
  c.grains->feed->x += 0.002 * width;
  EXPECT_EQ(said("grains.feed.height").size(), 1u);
  EXPECT_EQ(said("grains.feed.x").size(), 1u);
  EXPECT_TRUE(problems(grain_case("shape = \"clump\"\nclump = \"cube\"\nboundary_x = \"exit\"\n"
                                  "[grains.feed]\nrate = 10\nx = 1e-3\n"))
                  .empty());
  // A body leaves 0.08 mm beside it on each side: room for spheres of 0.15 mm, not for cubes.
  c.grains->feed->x = kX, c.grains->feed->height = 0;
  c.bodies = {{.name = "step",
               .shape = BodyShape::of<shapes::Box>(),
               .centre = {1e-3, 2e-3},
               .height = 1e-3,
               .size = {1e-3, 3.84e-3}}};
  const auto refused_of = [&](int kind) {
    const std::vector<SizeClass> small{{.diameter = kSmall, .count = 1, .kind = kind}};
    return message_of([&] { check_feed_places(c, widths_of(*c.grains, small)); });
  };
  EXPECT_EQ(refused_of(1), "");
  EXPECT_NE(refused_of(0), "");
}

/// Half of the grains are cubes of eight spheres; so are half of those that come in.
TEST(FedClumps, TakeTheMemoryOfTheirSpheres) {
  Config c = fed_case(FeedAmount::given, 2000);
  c.time.end = 0.5;
  const std::vector<SizeClass> sizes{{.diameter = kSmall, .count = 500, .kind = 0},
                                     {.diameter = kSmall, .count = 500, .kind = 1}};
  const double fed = memory_of_case(c, sizes);
  c.grains->feed.reset();
  const double unfed = memory_of_case(c, sizes);
  EXPECT_DOUBLE_EQ(unfed, 4500 * 1000.0);
  EXPECT_DOUBLE_EQ(fed, 2 * unfed);
}

}  // namespace
}  // namespace barchan
