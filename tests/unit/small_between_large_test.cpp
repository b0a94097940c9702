// A small grain that rolls down the crease between two large ones that touch, as in Vyas et al.
// (2025): it must leave the crease, and not hang in it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kSmall = 2.5e-4, kRatio = 10, kLarge = kRatio * kSmall;  // radii [m]
constexpr Real kGravity = 9.81, kStart = std::numbers::pi / 6;  // [m/s^2]; angle from the vertical
const Real kCrease = std::sqrt((kLarge + kSmall) * (kLarge + kSmall) - kLarge * kLarge);  // [m]

/// The large ones are so heavy that they stand still.
Config two_sizes() {
  Config config = bench_config({.restitution = 0.5, .sliding_friction = 0.5}, 2500, kLarge);
  config.grains->contact_model = ContactModel::of<LinearSpring>();
  config.grains->linear_stiffness = 1e4;
  config.grains->kinds = {
      {.name = "small", .density = 2500, .material = config.grains->material, .sizes = {}},
      {.name = "large", .density = 2.5e12, .material = config.grains->material, .sizes = {}}};
  return config;
}

/// Position of the small grain about the line through the centres of the large ones.
struct Place {
  Real angle, distance;
};

class Crease {
 public:
  Crease() : bench_(two_sizes(), grains()) {
    const auto force = mirror(bench_.state.fluid.explicit_force);
    const auto kin = bench_.kinematics();
    for (int g = 0; g < bench_.state.n; ++g)
      force(g) = kin(g).r < kLarge / 2 ? kin(g).m * Vec3{0, -kGravity, 0} : Vec3{};
    Kokkos::deep_copy(bench_.state.fluid.explicit_force, force);
  }
  Place after(Real time, Real dt) {
    bench_.advance(static_cast<int>(std::lround(time / dt)), dt);
    const Vec3 x = bench_.grain(1).x - kMiddle;
    return {std::atan2(x.z, x.y), std::hypot(x.y, x.z)};
  }

 private:
  static constexpr Vec3 kMiddle{50 * kLarge, 50 * kLarge, 50 * kLarge};
  static InitialGrains grains() {
    InitialGrains all;
    add_grain(all, 2 * kSmall, kMiddle + kCrease * Vec3{0, std::cos(kStart), std::sin(kStart)});
    for (const int side : {-1, 1}) add_grain(all, 2 * kLarge, kMiddle + Vec3{side * kLarge, 0, 0});
    all.kind = {0, 1, 1};
    return all;
  }
  GrainBench bench_;
};

/// Rolling without slip: the contacts are a = kCrease r / (R + r) from the axis of the spin,
/// angle'' = g sin(angle) / (kCrease (1 + 2/5 (r/a)^2)).
Real rolled_to(Real time) {
  const Real r_over_a = (kLarge + kSmall) / kCrease;
  const Real factor = kGravity / (kCrease * (1 + 0.4 * r_over_a * r_over_a));
  Real angle = kStart, rate = 0;
  constexpr int n = 100000;
  for (int k = 0; k < n; ++k) {
    rate += time / n * factor * std::sin(angle);
    angle += time / n * rate;
  }
  return angle;
}

TEST(SmallBetweenLarge, ItRollsDownTheCreaseAndLeavesIt) {
  for (const Real dt : {1e-6, 4e-6}) {
    SCOPED_TRACE(dt);
    Crease crease;
    const Place rolling = crease.after(0.02, dt);
    EXPECT_NEAR(rolling.angle / rolled_to(0.02), 1, 5e-3);
    EXPECT_NEAR(rolling.distance / kCrease, 1, 1e-3);
    const Place fallen = crease.after(0.04, dt);
    EXPECT_GT(fallen.distance, 2 * kCrease);
  }
}

}  // namespace
}  // namespace barchan
