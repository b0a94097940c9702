// Contacts of unlike grains against closed forms, pair by pair: rebound, duration, sliding.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kLarge = 1e-4;  // [m], radius of the first grain; the other one is smaller

/// Two kinds that differ in all they can; restitution and friction of their contacts are given.
Config unlike_kinds(Real restitution_of_both = 0.8) {
  const KindConfig heavy{.name = "heavy",
                         .density = 4000,
                         .material = {.youngs_modulus = 4e7,
                                      .poisson_ratio = 0.2,
                                      .restitution = 0.9,
                                      .sliding_friction = 0.2},
                         .sizes = {}};
  const KindConfig light{.name = "light",
                         .density = 1500,
                         .material = {.youngs_modulus = 5e6,
                                      .poisson_ratio = 0.45,
                                      .restitution = 0.5,
                                      .sliding_friction = 0.8},
                         .sizes = {}};
  Config config = bench_config(heavy.material, heavy.density, kLarge);
  config.grains->kinds = {heavy, light};
  config.grains->pairs = {{.kinds = {"light", "heavy"}, .restitution = restitution_of_both}};
  return config;
}

/// Two grains of these kinds with their surfaces at `gap` [m], the second of 0.6 of the first.
GrainBench two_grains(const Config& config, int a, int b, Real gap, const Vec3& velocity_of_first) {
  const Real r_b = 0.6 * kLarge;
  InitialGrains grains;
  const Real x = 50 * kLarge;
  add_grain(grains, 2 * kLarge, {x, x, x}, velocity_of_first);
  add_grain(grains, 2 * r_b, {x + kLarge + r_b + gap, x, x});
  grains.kind = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
  return GrainBench(config, grains);
}

const std::array<std::pair<int, int>, 4> kPairs{{{0, 0}, {0, 1}, {1, 0}, {1, 1}}};

struct Rebound {
  Real restitution = 0, duration = 0;
};

Rebound impact(const Config& config, int a, int b, Real v, Real dt) {
  const Real gap = 1.5 * dt * v;
  GrainBench bench = two_grains(config, a, b, gap, {v, 0, 0});
  const auto surfaces = [&] {
    const GrainKinematics one = bench.grain(1), two = bench.grain(2);
    return norm(two.x - one.x) - one.r - two.r;
  };
  bool touched = false;
  for (int n = 1; n < 1000000; ++n) {
    bench.advance(1, dt);
    const Real now = surfaces(), apart = bench.grain(2).u.x - bench.grain(1).u.x;
    touched = touched || now < 0;
    if (touched && now >= 0) return {apart / v, n * dt - now / apart - gap / v};
  }
  ADD_FAILURE() << "the grains never parted";
  return {};
}

TEST(UnlikeContacts, TheReboundIsThatOfThePair) {
  const Real expected[] = {0.9, 0.8, 0.8, 0.5};
  for (std::size_t p = 0; p < kPairs.size(); ++p) {
    const auto [a, b] = kPairs[p];
    EXPECT_NEAR(impact(unlike_kinds(), a, b, 0.02, 2e-8).restitution / expected[p], 1, 2e-3)
        << a << b;
  }
}

// Restitution without a [[grains.pair]]: the geometric mean, sqrt(0.9 0.5).
TEST(UnlikeContacts, TheReboundOfAMixedPairIsTheGeometricMean) {
  Config config = unlike_kinds();
  config.grains->pairs.clear();
  EXPECT_NEAR(impact(config, 0, 1, 0.02, 2e-8).restitution / std::sqrt(0.45), 1, 2e-3);
}

// Hertz: delta_max = (15 m v^2 / (16 sqrt(R) E))^(2/5), t = 2.94327 delta_max / v (Johnson 1985,
// 11.24), with m, R and E of both sides.
TEST(UnlikeContacts, TheDurationIsThatOfBothModuliMassesAndRadii) {
  Config config = unlike_kinds(1);
  for (KindConfig& kind : config.grains->kinds) kind.material.restitution = 1;
  const Real r_a = kLarge, r_b = 0.6 * kLarge, r = r_a * r_b / (r_a + r_b), v = 0.02;
  for (const auto& [a, b] : kPairs) {
    const KindConfig &one = config.grains->kinds[static_cast<std::size_t>(a)],
                     &two = config.grains->kinds[static_cast<std::size_t>(b)];
    const auto softness = [](const Material& m) {
      return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
    };
    const Real e = 1 / (softness(one.material) + softness(two.material));
    const Real m_a = one.density * sphere_volume(r_a), m_b = two.density * sphere_volume(r_b);
    const Real m = m_a * m_b / (m_a + m_b);
    const Real deepest = std::pow(15 * m * v * v / (16 * std::sqrt(r) * e), 0.4);
    EXPECT_NEAR(impact(config, a, b, v, 2e-8).duration / (2.94327 * deepest / v), 1, 2e-3)
        << a << b;
  }
}

// Driven past each other fast enough to slide at once: |F_t| = mu |F_n|, with the pair's mu.
TEST(UnlikeContacts, TheySlideAtTheFrictionOfThePair) {
  Config config = unlike_kinds();
  config.grains->pairs[0].sliding_friction = 0.35;
  const Real friction[] = {0.2, 0.35, 0.35, 0.8};
  constexpr Real overlap = 2e-7, dt = 1e-8;  // [m], [s]
  for (std::size_t p = 0; p < kPairs.size(); ++p) {
    const auto [a, b] = kPairs[p];
    GrainBench bench = two_grains(config, a, b, -overlap, {0, 2, 0});
    bench.advance(40, dt);
    const GrainKinematics one = bench.grain(1), two = bench.grain(2);
    const Vec3 normal = (1 / norm(one.x - two.x)) * (one.x - two.x), force = bench.contact_force(1);
    const Real f_n = dot(force, normal), f_t = norm(force - f_n * normal);
    ASSERT_GT(std::abs(f_n), 0);
    EXPECT_NEAR(f_t / std::abs(f_n) / friction[p], 1, 1e-9) << a << b;
  }
}

// A contact with the floor has the restitution of the walls, whatever the kind.
TEST(UnlikeContacts, AWallHasOneRestitutionForAllKinds) {
  Config config = unlike_kinds();
  config.grains->wall.restitution = 0.65;
  constexpr Real v = 0.02, dt = 2e-8;
  for (const int kind : {0, 1}) {
    InitialGrains grains;
    add_grain(grains, 2 * kLarge, {50 * kLarge, kLarge + 1.5 * dt * v, 50 * kLarge}, {0, -v, 0});
    grains.kind = {static_cast<std::uint8_t>(kind)};
    GrainBench bench(config, grains);
    while (bench.grain(1).u.y < 0 || bench.grain(1).x.y < kLarge) bench.advance(1, dt);
    EXPECT_NEAR(bench.grain(1).u.y / v / 0.65, 1, 2e-3) << kind;
  }
}

}  // namespace
}  // namespace barchan
