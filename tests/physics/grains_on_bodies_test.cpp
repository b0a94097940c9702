// Grains on bodies at rest: how deep they lie, when they stay, slide and roll, and where they
// leave.
#include <algorithm>
#include <numbers>

#include "src/bodies/make_bodies.hpp"
#include "tests/support/body_cases.hpp"

namespace barchan {
namespace {

using namespace test;

// Overlap of Hertz under its weight F: (3 F / (4 E* sqrt(R_eff)))^(2/3), R_eff = r R / (r + R) on a
// sphere. The body carries the weight, with its lever about the foot.
TEST(GrainsOnBodies, AGrainSinksInByHertz) {
  for (const BodyConfig& shape : all_shapes()) {
    const Config config = with_bodies(material(0.5, 0.3, 0.2), {shape});
    const BodyExtent extent = body_extent(shape, config.size);
    const Vec3 top{0.005, extent.high[1], 0.005};
    InitialGrains g;
    add_grain(g, 2 * kRadius, top + Vec3{0, kRadius, 0});
    GrainBench bench(config, g);
    set_weight(bench.state, {0, -kG, 0});
    bench.advance(60000, 5e-7);
    bench.advance(10, 5e-7);  // the mean of these alone
    const GrainKinematics k = bench.grain(1);
    const bool round = shape.shape.is<shapes::Sphere>() || shape.shape.is<shapes::HalfSphere>();
    const Real r_eff = round ? kRadius * shape.radius / (kRadius + shape.radius) : kRadius;
    const Real weight = k.m * kG;
    const Real sinks = std::pow(3 * weight / (4 * e_eff(config) * std::sqrt(r_eff)), 2.0 / 3);
    expect_relative(shape.name + ", it sinks by", top.y + kRadius - k.x.y, sinks, 1e-6);
    const GrainsOnBody on = bench.solver.body_loads()[0];
    expect_relative(shape.name + ", force over weight", on.load.force.y, -weight, 1e-6);
    expect_below(shape.name + ", other force over weight",
                 std::hypot(on.load.force.x, on.load.force.z) / weight, 1e-6);
    const Vec3 place = make_bodies(config.bodies, config.size).body[0].from_foot(k.x);
    const Vec3 torque = cross(place, Vec3{0, -weight, 0});
    expect_below(shape.name + ", torque over weight times r off by",
                 norm(on.load.torque - torque) / (weight * kRadius), 1e-4);
    EXPECT_EQ(on.contacts, 1);
  }
}

// A body pushed far from its foot: the torque is lever times weight.
TEST(GrainsOnBodies, TheTorqueIsAboutTheFoot) {
  const Config config = with_bodies(material(0.5, 0.3, 0.2), {all_shapes()[5]});
  InitialGrains g;
  add_grain(g, 2 * kRadius, {0.0056, 2e-3 + kRadius, 0.0047});
  GrainBench bench(config, g);
  set_weight(bench.state, {0, -kG, 0});
  bench.advance(60000, 5e-7);
  const Real weight = bench.grain(1).m * kG;
  const Vec3 torque = bench.solver.body_loads()[0].load.torque;
  const Vec3 place = bench.grain(1).x - Vec3{0.005, 0, 0.005};
  expect_relative("torque about x", torque.x, place.z * weight, 1e-4);
  expect_relative("torque about z", torque.z, -place.x * weight, 1e-4);
}

// Two grains on two bodies: each body gets its own.
TEST(GrainsOnBodies, EachBodyGetsWhatItsGrainsGive) {
  BodyConfig left = all_shapes()[5], right = all_shapes()[3];
  left.centre = {0.003, 0.005}, right.centre = {0.007, 0.005};
  const Config config = with_bodies(material(0.5, 0.3, 0.2), {left, right});
  InitialGrains g;
  add_grain(g, 2 * kRadius, {0.003, 2e-3 + kRadius, 0.005});
  add_grain(g, 2 * kRadius, {0.0034, 2e-3 + kRadius, 0.005});
  add_grain(g, 4 * kRadius, {0.007, 3e-3 + 2 * kRadius, 0.005});
  GrainBench bench(config, g);
  set_weight(bench.state, {0, -kG, 0});
  bench.advance(60000, 5e-7);
  bench.advance(10, 5e-7);
  const auto on = bench.solver.body_loads();
  EXPECT_EQ(on[0].contacts, 2);
  EXPECT_EQ(on[1].contacts, 1);
  expect_relative("two grains", on[0].load.force.y, -2 * bench.grain(1).m * kG, 1e-6);
  expect_relative("a grain eight times as heavy", on[1].load.force.y, -bench.grain(3).m * kG, 1e-6);
}

void move_out(const GrainState& grains) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: move out", grains.n, KOKKOS_LAMBDA(int g) { kin(g).x.x = -1e-4; });
}

// Loads of the last step with grains are not given again.
TEST(GrainsOnBodies, NothingPushesABodyOnceAllGrainsHaveLeft) {
  Config config = with_bodies(material(0.5, 0.3), {all_shapes()[5]});
  config.grains->boundary_x = GrainBoundaryX::exit;
  InitialGrains g;
  add_grain(g, 2 * kRadius, {0.005, 2e-3 + 0.999 * kRadius, 0.005});
  GrainBench bench(config, g);
  bench.advance(2, 5e-7);
  EXPECT_LT(bench.solver.body_loads()[0].load.force.y, 0);
  EXPECT_EQ(bench.solver.body_loads()[0].contacts, 1);
  move_out(bench.state);
  bench.solver.remove_left(bench.state);
  ASSERT_EQ(bench.state.n, 0);
  bench.advance(2, 5e-7);
  EXPECT_EQ(norm(bench.solver.body_loads()[0].load.force), 0);
  EXPECT_EQ(bench.solver.body_loads()[0].contacts, 0);
}

/// Speed down a slope after a time at rest under a tilted weight, on a box or a dune's flank.
struct Slide {
  Real speed, spin;
};
Slide slide(const Material& m, bool on_dune, Real angle, Real time) {
  Config config = with_bodies(m, {});
  const Real cosine = std::cos(angle), sine = std::sin(angle);
  InitialGrains g;
  Vec3 weight{0, -kG, 0};
  if (on_dune) {  // its stoss side rises along x
    config.bodies = {{.name = "dune",
                      .shape = BodyShape::of<shapes::Dune>(),
                      .centre = {0.0085, 0.005},
                      .height = 0.008 * std::tan(angle),
                      .size = {0.009, 0.009},
                      .lee = 0.001}};
    const Vec3 foot{0.0065, 0.006 * std::tan(angle), 0.005};
    add_grain(g, 2 * kRadius, foot + kRadius * Vec3{-sine, cosine, 0});
  } else {
    config.bodies = {{.name = "box",
                      .shape = BodyShape::of<shapes::Box>(),
                      .centre = {0.005, 0.005},
                      .height = 0.001,
                      .size = {0.009, 0.009}}};
    add_grain(g, 2 * kRadius, {0.0065, 1e-3 + kRadius, 0.005});
    weight = {-kG * sine, -kG * cosine, 0};
  }
  GrainBench bench(config, g);
  set_weight(bench.state, weight);
  bench.advance(static_cast<int>(time / 5e-7), 5e-7);
  const GrainKinematics k = bench.grain(1);
  return {norm(k.u), norm(k.omega)};
}

// A sphere slides where tan > 7/2 mu: acceleration g (sin - mu cos), spin 5/2 mu g cos / r. With
// rolling friction it stays where tan < mu_r.
TEST(GrainsOnBodies, AGrainOnASlopeStaysOrSlides) {
  const Real time = 0.01;
  for (const bool on_dune : {false, true}) {
    const std::string where = on_dune ? "on a dune" : "on a box";
    const Real angle = 0.45, mu = 0.1;
    const Slide slides = slide(material(mu, 0.1), on_dune, angle, time);
    const Real expected = kG * (std::sin(angle) - mu * std::cos(angle));
    expect_relative(where + ", it slides with", slides.speed / time, expected, 1e-4);
    expect_relative(where + ", and turns with", slides.spin / time,
                    2.5 * mu * kG * std::cos(angle) / kRadius, 1e-4);
    const Slide rolls = slide(material(0.6, 0.1), on_dune, angle, time);
    expect_relative(where + ", it rolls with", rolls.speed / time, kG * std::sin(angle) * 5 / 7,
                    1e-4);
    const Real mu_r = std::tan(angle);
    const Slide stays = slide(material(0.6, 0.1, 1.05 * mu_r), on_dune, angle, 5 * time);
    expect_below(where + ", below the angle of rolling it goes", stays.speed, 1e-6);
    const Slide goes = slide(material(0.6, 0.1, 0.9 * mu_r), on_dune, angle, 5 * time);
    expect_relative(where + ", above it", goes.speed / (5 * time),
                    0.1 * kG * std::sin(angle) * 5 / 7, 0.05);
  }
}

// A grain leaves the top of a sphere or a lying cylinder where cos = 2/3 if it slides without
// friction, and where cos = 10/17 if it rolls without slip, with the speed of its fall.
TEST(GrainsOnBodies, AGrainLeavesABallWhereTheoryPutsIt) {
  for (const std::size_t which : {std::size_t{2}, std::size_t{3}}) {
    for (const bool rolls : {false, true}) {
      BodyConfig shape = all_shapes()[which];
      shape.radius = 2e-3;
      const Config config = with_bodies(material(rolls ? 5 : 0, 0.5), {shape});
      const Real way = shape.radius + kRadius, begin = 0.05;
      const Vec3 centre{0.005, shape.base + shape.radius, 0.005};
      InitialGrains g;
      add_grain(g, 2 * kRadius, centre + (way - 1e-9) * Vec3{std::sin(begin), std::cos(begin), 0});
      GrainBench bench(config, g);
      set_weight(bench.state, {0, -kG, 0});
      const auto total = [&](const GrainKinematics& k) {
        return energy(k) + k.m * kG * (k.x.y - centre.y);
      };
      GrainKinematics k = bench.grain(1);
      const Real first = total(k);
      bench.advance(20000, 5e-7);
      for (int n = 0; n < 20000 && touches_body(bench); ++n) {
        k = bench.grain(1);
        bench.advance(20, 5e-7);
      }
      const Real cosine = (k.x.y - centre.y) / norm(k.x - centre);
      const Real expected = std::cos(begin) * (rolls ? 10.0 / 17 : 2.0 / 3);
      const std::string claim = shape.name + (rolls ? ", it rolls" : ", it slides");
      expect_relative(claim + ", and leaves at cos", cosine, expected, 5e-3);
      expect_below(claim + ", energy off by", std::abs(total(k) - first) / (k.m * kG * way), 1e-4);
    }
  }
}

// A grain rolls around a lying cylinder, pressed on by a force that turns with it. It does not
// slip, and its spring stays in the tangent plane and near zero, turn after turn.
TEST(GrainsOnBodies, ASpringDoesNotDriftAroundACylinder) {
  BodyConfig shape = all_shapes()[2];
  shape.base = 3e-3;
  const Config config = with_bodies(material(0.5, 0.2), {shape});
  const Real way = shape.radius + kRadius, rate = 100;  // [1/s]
  const Vec3 centre{0.005, shape.base + shape.radius, 0.005};
  InitialGrains g;
  add_grain(g, 2 * kRadius, centre + Vec3{way - 2e-8, 0, 0}, {0, rate * way, 0},
            {0, 0, rate * way / kRadius});
  GrainBench bench(config, g);
  const Real dt = 1e-6, press = 50;
  constexpr int kSteps = 50, kTurns = 3;
  Real along = 0, stretched = 0, turned = 0, slip = 0;
  while (turned < kTurns * 2 * std::numbers::pi) {
    const Vec3 n = (1 / norm(bench.grain(1).x - centre)) * (bench.grain(1).x - centre);
    const Real ahead = rate * kSteps * dt / 2;
    set_weight(bench.state, -press * (std::cos(ahead) * n + std::sin(ahead) * Vec3{-n.y, n.x, 0}));
    bench.advance(kSteps, dt);
    ASSERT_TRUE(touches_body(bench)) << "after " << turned;
    const GrainKinematics k = bench.grain(1);
    turned += norm(k.u) / way * kSteps * dt;
    if (turned < std::numbers::pi) continue;
    const Vec3 now = (1 / norm(k.x - centre)) * (k.x - centre);
    const auto xi = host_copy(bench.state.body_xi_t);
    along = std::max(along, std::abs(dot(xi(0, 0), now)));
    stretched = std::max(stretched, norm(xi(0, 0)));
    slip = std::max(slip, std::abs(k.omega.z * k.r / norm(k.u) - 1));
  }
  const Real mass = bench.grain(1).m, speed = norm(bench.grain(1).u);
  const Real force = mass * (press - speed * speed / way);
  const Real sinks = std::pow(3 * force / (4 * e_eff(config) * std::sqrt(kRadius)), 2.0 / 3);
  expect_below("slip over speed", slip, 1e-3);
  expect_below("spring over overlap", stretched / sinks, 0.01);
  expect_below("its part along the normal over overlap", along / sinks, 1e-3);
}

}  // namespace
}  // namespace barchan
