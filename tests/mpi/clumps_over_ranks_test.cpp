// Clumps of spheres over ranks against the same clumps on one rank, and across a restart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "src/base/report.hpp"
#include "src/grains/grain_feed.hpp"
#include "src/initial/grain_files.hpp"
#include "src/parallel/reduce.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/shared_grains.hpp"

namespace barchan {
namespace {

using test::by_id;
using test::from_all_ranks;
using test::numbers_of;

bool is_first() { return rank_of(MPI_COMM_WORLD) == 0; }

Config clump_box(std::array<double, 3> size, NamedClump name) {
  Config c = test::clump_config(name);
  c.size = size;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  return c;
}

/// Clumps on a lattice with random speeds, so wide apart that none overlap at first.
InitialGrains loose_clumps(int n, const std::array<double, 3>& size, Real speed) {
  test::Uniform uniform(4);
  const Real pitch = 4e-4;
  const int nx = static_cast<int>(size[0] / pitch), nz = static_cast<int>(size[2] / pitch);
  InitialGrains grains;
  for (int g = 0; g < n; ++g) {
    const auto component = [&] { return speed * (2 * uniform() - 1); };
    const Vec3 x{(g % nx + 0.5) * size[0] / nx, (g / (nx * nz) + 0.5) * pitch,
                 (g / nx % nz + 0.5) * size[2] / nz};
    const Real u = component(), v = component(), w = component();
    const Real d = 1.5e-4 + 1e-4 * uniform();
    test::add_grain(grains, d, x, {u, v, w}, {1e3 * uniform(), 0, 1e3 * uniform()});
  }
  return grains;
}

/// One case twice: on one rank, and among all.
struct SharedClumps {
  SharedClumps(const Config& c, const InitialGrains& grains)
      : whole(c, grains), shared(c, grains, MPI_COMM_WORLD) {}
  void advance(int n, Real dt) {
    whole.advance(n, dt);
    shared.advance(n, dt);
  }
  std::vector<double> off() const {
    return test::differences(by_id(numbers_of(whole.state)),
                             by_id(from_all_ranks(numbers_of(shared.state))));
  }
  test::ClumpBench whole, shared;
};

/// Owned spheres of each pair over all lists: two for every pair.
std::map<std::pair<double, double>, int> owned_in(const GrainState& s, bool of_all_ranks) {
  const auto i = host_copy(s.list.i), j = host_copy(s.list.j);
  const auto id = host_copy(s.id);
  std::vector<double> pairs;
  for (int p = 0; p < s.list.n_pairs; ++p) {
    const auto [a, b] = std::minmax({id(i(p)), id(j(p))});
    pairs.push_back(static_cast<double>(a));
    pairs.push_back(static_cast<double>(b));
    pairs.push_back((i(p) < s.n) + (j(p) < s.n));
  }
  if (of_all_ranks) pairs = from_all_ranks(pairs);
  std::map<std::pair<double, double>, int> owned;
  for (std::size_t p = 0; p < pairs.size(); p += 3)
    owned[{pairs[p], pairs[p + 1]}] += static_cast<int>(pairs[p + 2]);
  return owned;
}

TEST(ClumpsOverRanks, PairsAreThoseOfOneRank) {
  for (const NamedClump name : {NamedClump::dimer, NamedClump::cube, NamedClump::sand}) {
    const std::array<double, 3> size{0.004, 0.003, 0.003};
    const SharedClumps s(clump_box(size, name), test::random_grains(700, size, 4));
    const auto whole = owned_in(s.whole.state, false);
    ASSERT_GT(whole.size(), 1000u);
    EXPECT_EQ(whole, owned_in(s.shared.state, true));
    const ClumpMembers& members = s.shared.state.members;
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, members.n), 700);
  }
}

/// Bits may differ: contacts are added in the order of a rank's rows.
TEST(ClumpsOverRanks, OneGrainStepAsOnOneRank) {
  for (const NamedClump name : {NamedClump::tetrahedron, NamedClump::cube, NamedClump::sand}) {
    const Config c = clump_box({0.004, 0.003, 0.0032}, name);
    SharedClumps s(c, loose_clumps(500, c.size, 0.5));
    for (test::ClumpBench* bench : {&s.whole, &s.shared})
      test::set_weight(bench->state, {0, -9.81, 0});
    s.advance(400, 1e-6);
    s.advance(1, 1e-6);
    const auto off = s.off();
    for (const double difference : off) EXPECT_LT(difference, 1e-12);
    const ContactSummary a = s.whole.solver.contacts(s.whole.state),
                         b = s.shared.solver.contacts(s.shared.state);
    EXPECT_GT(a.n_contacts, 20);
    EXPECT_EQ(a.n_contacts, b.n_contacts);
    const std::int64_t migrated = sum_over(MPI_COMM_WORLD, s.shared.solver.list().n_migrated());
    EXPECT_TRUE(rank_count(MPI_COMM_WORLD) == 1 || migrated > 0);
    if (is_first())
      std::printf("[ measured ] x %.1e, u %.1e, omega %.1e, force %.1e, torque %.1e\n", off[0],
                  off[1], off[2], off[3], off[4]);
  }
}

/// Both ranks of a pair take it as the same: nothing else keeps the momentum, over many migrations
/// and rebuilds. The walls are without friction.
TEST(ClumpsOverRanks, MomentumStays) {
  Config c = clump_box({0.004, 0.003, 0.0032}, NamedClump::cube);
  c.grains->wall.sliding_friction = 0;
  c.grains->material.restitution = 0.9;
  test::ClumpBench bench(c, loose_clumps(400, c.size, 0.5), MPI_COMM_WORLD);
  const auto along_floor = [&] {
    const Vec3 p = test::sums_of(bench.state).momentum;
    return Vec2{sum_over(MPI_COMM_WORLD, p.x), sum_over(MPI_COMM_WORLD, p.z)};
  };
  const Vec2 before = along_floor();
  const ClumpMotion one = as_spheres(loose_clumps(1, c.size, 0.5), *c.grains, 1).clump[0];
  for (int n = 0; n < 20; ++n) {
    bench.advance(100, 2e-6);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, grain_count(bench.state)), 400);
  }
  const Vec2 after = along_floor();
  EXPECT_LT(std::abs(after.x - before.x), 1e-11 * one.m);
  EXPECT_LT(std::abs(after.z - before.z), 1e-11 * one.m);
  const std::int64_t migrated = sum_over(MPI_COMM_WORLD, bench.solver.list().n_migrated());
  EXPECT_TRUE(rank_count(MPI_COMM_WORLD) == 1 || migrated > 200) << migrated;
  EXPECT_GT(bench.solver.contacts(bench.state).n_contacts, 5);
}

/// The feed brings the same clumps in at the same places, turned alike, and those that left with
/// the same sizes.
TEST(ClumpsOverRanks, AFeedBringsInWhatItBringsInOnOneRank) {
  for (const FeedAmount amount : {FeedAmount::given, FeedAmount::as_lost}) {
    Config c = clump_box({0.004, 0.004, 0.0048}, NamedClump::cube);
    c.grains->boundary_x = GrainBoundaryX::exit;
    c.grains->kinds.resize(2);
    c.grains->kinds[0].name = "cube", c.grains->kinds[1].name = "sphere";
    std::swap(c.grains->kinds[0].shape, c.grains->shape);
    c.grains->feed = FeedConfig{.amount = amount, .rate = 2e4, .x = 5e-5, .height = 3e-3};
    c.time.fluid_step = 1e-4;
    InitialGrains grains = loose_clumps(600, c.size, 0.8);
    for (int g = 0; g < 600; ++g) grains.kind.push_back(g % 3 == 2 ? 1 : 0);
    SharedClumps s(c, grains);
    GrainFeed of_whole(c), of_shared(c);
    for (int step = 0; step < 20; ++step) {
      s.advance(25, 4e-6);
      of_whole.advance(s.whole.state, s.whole.solver.list());
      of_shared.advance(s.shared.state, s.shared.solver.list());
    }
    const FeedState &a = s.whole.state.feed, &b = s.shared.state.feed;
    EXPECT_GT(a.n_fed, 10);
    EXPECT_EQ(a.n_fed, b.n_fed);
    EXPECT_EQ(a.n_tries, b.n_tries);
    EXPECT_EQ(a.waiting, b.waiting);
    EXPECT_EQ(a.bodies, b.bodies);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, s.shared.state.n), s.whole.state.n);
    const std::int64_t n = sum_over(MPI_COMM_WORLD, grain_count(s.shared.state)),
                       n_left = sum_over(MPI_COMM_WORLD, s.shared.state.n_left);
    EXPECT_GT(n_left, 5);
    EXPECT_EQ(n + n_left, 600 + b.n_fed);
    const auto off = s.off();  // infinite if the numbers are not the same
    EXPECT_LT(off[0], 1e-6);
    if (is_first())
      std::printf("[ measured ] %d ranks: %lld fed, x %.1e\n", rank_count(MPI_COMM_WORLD),
                  static_cast<long long>(a.n_fed), off[0]);
  }
}

/// A heap of cubes in the middle of a wide box, dry.
Config cubes_config(double end) {
  Config c;
  c.title = "cubes";
  c.size = {0.012, 0.004, 0.006};
  c.grains.emplace();
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->shape = {.shape = GrainShape::clump, .clump = NamedClump::cube};
  c.grains->sizes = {{2e-4, 24}};
  c.grains->material.restitution = c.grains->wall.restitution = 0.2;
  c.initial.pour.emplace();
  c.initial.pour->centre = {0.006, 0.003};
  c.initial.pour->radius = 8e-4;
  c.time.fluid_step = 1e-4;
  c.time.grain_step = 2e-6;
  c.time.end = end;
  c.output.history_interval = 0.005;
  c.output.grains_interval = end;
  c.output.dune_interval = 0.01;
  return c;
}

std::filesystem::path run(const Config& config, const std::filesystem::path& folder,
                          const std::optional<std::filesystem::path>& restart = {}) {
  report::start(report::Shown::problems);
  Simulation simulation(config, {.folder = folder, .restart = restart}, {});
  EXPECT_EQ(simulation.run(), Outcome::done);
  report::stop_log();
  MPI_Barrier(MPI_COMM_WORLD);
  return *simulation.last_restart();
}

/// Cubes come to rest in a box that they do not fill; a run in two pieces has the bits of one in a
/// single piece.
TEST(ClumpsOverRanks, CubesComeToRestAndARestartKeepsTheBits) {
  if (rank_count(MPI_COMM_WORLD) > 2) GTEST_SKIP() << "on 1 and 2 ranks";
  const test::SharedFolder folder;
  const Config whole = cubes_config(0.12), half = cubes_config(0.03);
  const auto at_once = run(whole, folder.path() / "whole");
  const auto middle = run(half, folder.path() / "parts");
  const auto in_parts = run(whole, folder.path() / "parts", middle);
  if (!is_first()) return;
  test::expect_same_state(at_once, in_parts);
  const Hdf5File file(at_once, Hdf5File::Mode::read);
  const auto clumps = file.read<double>("grains/clump");
  const auto ids = file.read<std::int64_t>("grains/id");
  ASSERT_EQ(ids.size(), 8u * 24);
  int heads = 0;
  Real fastest = 0, highest = 0, momentum = 0, mass = 0;
  for (std::size_t e = 0; e < ids.size(); ++e) {
    if (member_of_id(ids[e]) > 0) continue;
    ClumpMotion c;
    std::memcpy(static_cast<void*>(&c), clumps.data() + e * 16, sizeof(c));
    ++heads;
    fastest = std::max(fastest, norm(c.u));
    highest = std::max(highest, c.x.y);
    momentum += norm(c.j), mass += c.m;
  }
  EXPECT_EQ(heads, 24);
  // A case may start from the grains of either file.
  const InitialGrains of_restart = read_grains(at_once),
                      of_frame = read_grains(folder.path() / "whole" / "grains.h5");
  ASSERT_EQ(of_restart.size(), 24u);
  ASSERT_EQ(of_frame.id, of_restart.id);
  for (std::size_t g = 0; g < 24; ++g) {
    EXPECT_EQ(of_restart.diameter[g], 2e-4);
    EXPECT_EQ(of_frame.diameter[g], 2e-4);
    EXPECT_EQ(norm(of_frame.x[g] - of_restart.x[g]), 0);
    EXPECT_EQ(of_frame.q[g].w, of_restart.q[g].w);
    EXPECT_EQ(norm(of_frame.q[g].vec() - of_restart.q[g].vec()), 0);
  }
  EXPECT_LT(fastest, 2e-4);  // fell at 0.1 m/s
  EXPECT_LT(highest, 1.2e-3);
  EXPECT_LT(momentum, 1e-3 * mass * 1e-4 * 0.1);
}

/// Cubes that are fed while others leave: a run in two pieces has the bits of one in a single
/// piece.
TEST(ClumpsOverRanks, ARestartKeepsTheBitsOfAFeed) {
  if (rank_count(MPI_COMM_WORLD) > 2) GTEST_SKIP() << "on 1 and 2 ranks";
  for (const FeedAmount amount : {FeedAmount::given, FeedAmount::as_lost}) {
    const test::SharedFolder folder;
    const auto fed = [&](double end) {
      Config c = cubes_config(end);
      c.grains->boundary_x = GrainBoundaryX::exit;
      c.grains->gravity = {20, -9.81, 0};  // steeper than they rest on
      c.grains->feed = FeedConfig{.amount = amount, .x = 1e-3};
      if (amount == FeedAmount::given) c.grains->feed->rate = 500;
      return c;
    };
    const auto at_once = run(fed(0.06), folder.path() / "whole");
    const auto middle = run(fed(0.032), folder.path() / "parts");
    const auto in_parts = run(fed(0.06), folder.path() / "parts", middle);
    if (!is_first()) continue;
    test::expect_same_state(at_once, in_parts);
    const auto number = [](const std::filesystem::path& file, const std::string& name) {
      return CheckpointReader(file).integer(name);
    };
    EXPECT_GT(number(middle, "feed/n_fed"), 3);
    EXPECT_GT(number(at_once, "feed/n_fed"), number(middle, "feed/n_fed"));
    EXPECT_GT(number(at_once, "grains/n_left"), number(middle, "grains/n_left"));
    const Hdf5File of(at_once, Hdf5File::Mode::read);
    const auto n_spheres = static_cast<std::int64_t>(of.read<std::int64_t>("grains/id").size());
    EXPECT_EQ(n_spheres,
              8 * (24 + number(at_once, "feed/n_fed") - number(at_once, "grains/n_left")));
  }
}

/// A feed that is new at a restart looks for a place for whole cubes: beside a body that leaves
/// 0.1 mm on each side spheres of theirs would have one.
TEST(ClumpsOverRanks, AFeedThatIsNewAtARestartNeedsAPlaceForWholeClumps) {
  const test::SharedFolder folder;
  const auto beside = [&](double gap) {
    Config c = cubes_config(0.001);
    c.grains->boundary_x = GrainBoundaryX::exit;
    c.bodies = {{.name = "step",
                 .shape = BodyShape::of<shapes::Box>(),
                 .centre = {1e-3, c.size[2] / 2},
                 .height = 1e-3,
                 .size = {1e-3, c.size[2] - 2 * gap}}};
    return c;
  };
  const auto refusal = [&](double gap) {
    Config c = beside(gap);
    const std::string name = fmt::format("{:.3g}", gap);
    const auto first = run(c, folder.path() / name);
    c.time.end = 0.002;
    c.grains->feed = FeedConfig{.rate = 100, .x = 1e-3};
    return message_of([&] { run(c, folder.path() / (name + " fed"), first); });
  };
  EXPECT_NE(refusal(1e-4).find("no grain could come in"), std::string::npos);
  EXPECT_EQ(refusal(1.8e-4), "");
}

}  // namespace
}  // namespace barchan
