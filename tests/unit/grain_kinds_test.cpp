// Grains of several kinds: each contact has the law of its two sides.
#include "src/grains/grain_kinds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/parallel/mirror.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kRadius = 1e-4, kOverlap = 1e-7, kDensity = 2500;  // [m], [m], [kg/m^3]

Material material(double youngs_modulus, double restitution, double friction) {
  Material m;
  m.youngs_modulus = youngs_modulus;
  m.restitution = restitution;
  m.sliding_friction = friction;
  return m;
}

const GrainKinds kTwoKinds{.material = {material(5e6, 0.9, 0.2), material(4e7, 0.5, 0.7)},
                           .unlike = {{{0, 1}, material(0, 0.3, 0.4)}}};

/// Pairs that overlap at rest far from each other, their grains of the kinds given; the last grain
/// touches the floor. Ids count from 1.
struct Pairs {
  Config config = bench_config(kTwoKinds.material[0], kDensity, kRadius);
  GrainState state;
  GrainSolver solver;

  explicit Pairs(const std::vector<std::array<int, 2>>& kinds, int on_floor)
      : state(make(kinds, on_floor)), solver(with_still_air(config), state, kTwoKinds) {
    solver.start(state);
    solver.advance(state, 1, 1e-12);
  }
  /// Magnitude of the contact force on a grain [N].
  Real force(std::int64_t id) const {
    const auto ids = host_copy(state.id);
    const auto forces = host_copy(state.contact_force);
    for (int g = 0; g < state.n; ++g)
      if (ids(g) == id) return norm(forces(g));
    return -1;
  }

 private:
  static Config with_still_air(Config c) {
    c.grains->gravity = {0, 0, 0};
    return c;
  }
  static GrainState make(const std::vector<std::array<int, 2>>& kinds, int on_floor) {
    InitialGrains grains;
    std::vector<int> kind;
    std::int64_t id = 0;
    // Place the grains from the far end on: the list then changes their order.
    for (std::size_t p = 0; p < kinds.size(); ++p) {
      const Real x = 90 * kRadius - 10 * kRadius * static_cast<Real>(p);
      for (const int side : {0, 1}) {
        grains.add(++id, 2 * kRadius,
                   {x + side * (2 * kRadius - kOverlap), 20 * kRadius, 30 * kRadius});
        kind.push_back(kinds[p][static_cast<std::size_t>(side)]);
      }
    }
    grains.add(++id, 2 * kRadius, {50 * kRadius, kRadius - kOverlap, 60 * kRadius});
    kind.push_back(on_floor);
    GrainState s = make_grain_state(grains, kDensity);
    s.kind = Kokkos::View<std::uint8_t*>("kind", kind.size());
    const auto host = mirror(s.kind);
    for (std::size_t g = 0; g < kind.size(); ++g) host(g) = static_cast<std::uint8_t>(kind[g]);
    Kokkos::deep_copy(s.kind, host);
    return s;
  }
};

Real hertz(const Material& a, const Material& b, Real r_eff) {
  const Real e = effective_youngs_modulus({a.youngs_modulus, a.poisson_ratio},
                                          {b.youngs_modulus, b.poisson_ratio});
  return Real(4) / 3 * e * std::sqrt(r_eff) * std::pow(kOverlap, 1.5);
}

TEST(GrainKinds, EachContactHasTheElasticityOfItsTwoSides) {
  const Pairs pairs({{0, 0}, {1, 1}, {0, 1}, {1, 0}}, 1);
  const auto& [soft, hard] = std::array{kTwoKinds.material[0], kTwoKinds.material[1]};
  const Real r = kRadius / 2;
  for (const auto& [id, force] : {std::pair{1, hertz(soft, soft, r)},
                                  {2, hertz(soft, soft, r)},
                                  {3, hertz(hard, hard, r)},
                                  {5, hertz(soft, hard, r)},
                                  {6, hertz(soft, hard, r)},
                                  {7, hertz(soft, hard, r)},
                                  {9, hertz(hard, pairs.config.grains->wall, kRadius)}}) {
    EXPECT_NEAR(pairs.force(id) / force, 1, 1e-6) << id;
  }
}

TEST(GrainKinds, FrictionAndRestitutionAreOfThePair) {
  const GrainConfig config = *bench_config(kTwoKinds.material[0], kDensity, kRadius).grains;
  const auto pairs = std::get<LawTable<HertzMindlin, true>>(laws_of_pairs(config, kTwoKinds));
  const auto walls = std::get<LawTable<HertzMindlin, true>>(laws_of_walls(config, kTwoKinds));
  EXPECT_EQ(pairs.friction[law_entry(0, 1)].sliding, 0.4);
  EXPECT_EQ(pairs.friction[law_entry(1, 0)].sliding, 0.4);
  EXPECT_EQ(pairs.friction[law_entry(1, 1)].sliding, 0.7);
  EXPECT_EQ(walls.friction[law_entry(1, 0)].sliding, config.wall.sliding_friction);
  EXPECT_DOUBLE_EQ(pairs.stiffness[law_entry(1, 0)].damping, damping_ratio(0.3));
  EXPECT_DOUBLE_EQ(pairs.stiffness[law_entry(0, 0)].damping, damping_ratio(0.9));
  EXPECT_THROW(laws_of_pairs(config, {.material = {{}, {}}, .unlike = {}}), std::out_of_range);
  EXPECT_THROW(laws_of_pairs(config, {.material = std::vector<Material>(5), .unlike = {}}),
               std::length_error);
}

// The stiffer kind shortens the step for which contacts are stable.
TEST(GrainKinds, TheStableStepKnowsTheLawOfEachContact) {
  const Pairs soft({{0, 0}}, 0), hard({{1, 1}}, 0), mixed({{0, 0}, {1, 1}}, 0);
  EXPECT_LT(hard.solver.stable_step(hard.state), 0.5 * soft.solver.stable_step(soft.state));
  EXPECT_DOUBLE_EQ(mixed.solver.stable_step(mixed.state), hard.solver.stable_step(hard.state));
}

}  // namespace
}  // namespace barchan
