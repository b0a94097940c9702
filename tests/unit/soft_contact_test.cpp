// Contacts a tenth of the diameter deep: the two surfaces meet r - delta/2 from either centre.
#include <gtest/gtest.h>

#include <cmath>

#include "src/parallel/mirror.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using test::add_grain;
using test::grain_config;
using test::GrainBench;

/// Two unequal grains side by side along x, at rest but for their spins about z.
struct SoftPair {
  Real r_a = 1e-4, r_b = 2e-4, delta = 3e-5;
  Real arm_a = r_a - delta / 2, arm_b = r_b - delta / 2;

  GrainBench start(Real omega_a, Real omega_b, const Config& config = grain_config()) const {
    InitialGrains g;
    add_grain(g, 2 * r_a, {0.005, 0.005, 0.005}, {}, {0, 0, omega_a});
    add_grain(g, 2 * r_b, {0.005 + arm_a + arm_b, 0.005, 0.005}, {}, {0, 0, omega_b});
    GrainBench c(config, g);
    c.advance(1, 1e-9);
    return c;
  }
};

TEST(SoftContact, GrainsThatMeshLikeGearsFeelNoFriction) {
  const SoftPair pair;
  const GrainBench c = pair.start(200, -200 * pair.arm_a / pair.arm_b);
  const Vec3 force = c.contact_force(1);
  EXPECT_LT(force.x, 0) << "they touch";
  EXPECT_LT(std::abs(force.y), 1e-14 * -force.x);
}

TEST(SoftContact, ForceActsWhereTheSurfacesMeet) {
  const SoftPair pair;
  const GrainBench c = pair.start(200, 300);
  EXPECT_LT(c.contact_force(1).y, 0) << "friction";
  const Vec3 a = cross({pair.arm_a, 0, 0}, c.contact_force(1));
  const Vec3 b = cross({-pair.arm_b, 0, 0}, c.contact_force(2));
  EXPECT_LT(norm(c.contact_torque(1) - a), 1e-11 * norm(a));
  EXPECT_LT(norm(c.contact_torque(2) - b), 1e-11 * norm(b));
}

TEST(SoftContact, GrainsThatTurnTogetherDoNotRoll) {
  const SoftPair pair;
  Config config = grain_config();
  config.grains->material.rolling_friction = 0.3;
  for (const RollingModel model : {RollingModel::of<Epsd2>(), RollingModel::of<ThetaM>(),
                                   RollingModel::of<ConstantTorque>()}) {
    config.grains->rolling_model = model;
    for (const Real omega_b : {200, -100}) {
      const GrainBench c = pair.start(200, omega_b, config);
      const Vec3 a = c.contact_torque(1) - cross({pair.arm_a, 0, 0}, c.contact_force(1));
      const Vec3 b = c.contact_torque(2) - cross({-pair.arm_b, 0, 0}, c.contact_force(2));
      const Real size = norm(c.contact_torque(1));
      if (omega_b == 200) {
        EXPECT_LT(norm(a) + norm(b), 1e-11 * size);
      } else {
        EXPECT_LT(a.z, -1e-9 * size) << "against the rolling";
        EXPECT_LT(std::abs(a.z + b.z), 1e-3 * std::abs(a.z));
      }
    }
  }
}

TEST(SoftContact, WrittenPartsAreAlongAndAcrossTheLineOfCentres) {
  const GrainBench c = SoftPair().start(200, 300);
  const Kokkos::View<Vec3*> along("along", 2), across("across", 2);
  c.solver.split_contacts(c.state, along, across);
  const auto normal = host_copy(along), tangential = host_copy(across);
  const auto ids = host_copy(c.state.id);
  for (int g = 0; g < 2; ++g) {
    const Vec3 force = c.contact_force(ids(g));
    EXPECT_NEAR(norm(normal(g) - Vec3{force.x, 0, 0}), 0, 1e-14 * norm(force));
    EXPECT_NEAR(norm(tangential(g) - Vec3{0, force.y, 0}), 0, 1e-14 * norm(force));
  }
}

/// A grain pressed into the floor, with a velocity along x and a spin about z.
struct SoftGrainOnFloor {
  Real r = 1e-4, delta = 2e-5, arm = r - delta / 2;

  GrainBench start(Real u, Real omega) const {
    InitialGrains g;
    add_grain(g, 2 * r, {0.005, r - delta, 0.005}, {u, 0, 0}, {0, 0, omega});
    GrainBench c(grain_config(), g);
    c.advance(1, 1e-9);
    return c;
  }
};

TEST(SoftContact, RollingOnTheFloorMeetsNoFriction) {
  const SoftGrainOnFloor grain;
  const Vec3 force = grain.start(-grain.arm * 200, 200).contact_force(1);
  EXPECT_GT(force.y, 0) << "it touches";
  EXPECT_LT(std::abs(force.x), 1e-14 * force.y);
}

TEST(SoftContact, TheFloorActsWhereItIsTouched) {
  const SoftGrainOnFloor grain;
  const GrainBench c = grain.start(0.05, 0);
  const Vec3 force = c.contact_force(1), torque = cross({0, -grain.arm, 0}, force);
  EXPECT_LT(force.x, 0) << "friction";
  EXPECT_LT(norm(c.contact_torque(1) - torque), 1e-11 * norm(torque));
}

// Each wall remembers what slid along it: in a corner, where the grain rolls on the floor along z
// and slides along the side, the spring of the side grows with the way.
TEST(SoftContact, WallsOfACornerHaveTheirOwnSprings) {
  Config config = grain_config();
  config.grains->boundary_x = GrainBoundaryX::wall;
  config.grains->material.restitution = config.grains->wall.restitution = 1;
  const Real r = 1e-4, delta = 1e-6, u = 0.01;
  InitialGrains g;
  add_grain(g, 2 * r, {r - delta, r - delta, 0.005}, {0, 0, u}, {u / (r - delta / 2), 0, 0});
  GrainBench c(config, g);
  c.advance(100, 5e-9);
  const Real after_half = c.contact_force(1).z;
  c.advance(100, 5e-9);
  EXPECT_LT(after_half, 0);
  EXPECT_NEAR(c.contact_force(1).z / after_half, 2, 0.03);  // it springs back a little meanwhile
}

// A grain that was dragged over the floor, has left it and falls again meets it as one that is new.
TEST(SoftContact, AWallForgetsAnEarlierTouch) {
  Material material;
  material.restitution = 0.9;
  const Real r = 1e-4, dt = 1e-6;
  Config config = test::bench_config(material, 2500, r);
  config.grains->gravity = {0, 0, 0};
  InitialGrains grains;
  const Vec3 above{50 * r, r + 1e-7, 50 * r};
  add_grain(grains, 2 * r, above, {0.02, -0.01, 0});
  GrainBench used(config, grains), fresh(config, grains);
  used.advance(400, dt);
  ASSERT_GT(used.grain(1).u.y, 0) << "it has left";
  ASSERT_NE(host_copy(used.state.wall_xi_t)(0, 0).x, 0) << "it was dragged";
  for (GrainBench* bench : {&used, &fresh}) {
    const auto kin = host_copy(bench->state.kin);
    kin(0).x = above, kin(0).u = {0, -0.01, 0}, kin(0).omega = {};
    Kokkos::deep_copy(bench->state.kin, kin);
    bench->advance(400, dt);
    EXPECT_GT(bench->grain(1).u.y, 0) << "it has touched again";
  }
  EXPECT_EQ(used.grain(1).u.x, fresh.grain(1).u.x);
  EXPECT_EQ(used.grain(1).omega.z, fresh.grain(1).omega.z);
}

}  // namespace
}  // namespace barchan
