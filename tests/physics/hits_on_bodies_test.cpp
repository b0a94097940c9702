// Grains that hit bodies at rest: how they come off, and that both give each other the same.
#include <algorithm>
#include <utility>

#include "src/bodies/make_bodies.hpp"
#include "tests/support/body_cases.hpp"

namespace barchan {
namespace {

using namespace test;

/// Grain that comes close to a body at random.
struct Hit {
  Config config;
  GrainBench bench;
  Vec3 normal;  // of the body where it begins

  static InitialGrains grain(const Vec3& x, const Vec3& u, const Vec3& omega) {
    InitialGrains g;
    add_grain(g, 2 * kRadius, x, u, omega);
    return g;
  }
  Hit(const Config& c, const Vec3& x, const Vec3& u, const Vec3& omega, const Vec3& n)
      : config(c), bench(c, grain(x, u, omega)), normal(n) {}

  /// Runs until the grain has left; false if it does not.
  bool leaves(Real dt) {
    bool has_touched = false;
    for (int n = 0; n < 500; ++n) {
      bench.advance(20, dt);
      const bool now = touches_body(bench);
      if (has_touched && !now) return true;
      has_touched = has_touched || now;
    }
    return false;
  }
};

/// A body alone, among grains of a material.
struct Solid {
  Config config;
  BodyExtent extent;
  Body body;

  Solid(const BodyConfig& shape, const Material& grains)
      : config(with_bodies(grains, {shape})),
        extent(body_extent(shape, config.size)),
        body(make_bodies(config.bodies, config.size).body[0]) {}
};

/// A place near the surface from where a grain soon touches it, with the normal there.
std::pair<Vec3, Vec3> place_near(const Solid& solid, Uniform& uniform) {
  const BodyExtent& extent = solid.extent;
  const Body& body = solid.body;
  for (;;) {
    Vec3 x;
    const auto between = [&](double low, double high) {
      return low - 5e-4 + (high - low + 1e-3) * uniform();
    };
    x = {between(extent.low[0], extent.high[0]), between(extent.low[1], extent.high[1]),
         between(extent.low[2], extent.high[2])};
    const ToSurface at = body.to_surface(x);
    if (at.distance < 0.2 * kRadius || at.distance > 3 * kRadius) continue;
    const Vec3 place = x + (1.02 * kRadius - at.distance) * at.normal;
    const ToSurface there = body.to_surface(place);
    const bool inside = place.y > 1.1 * kRadius && place.y < 0.0098 && place.x > 2 * kRadius &&
                        place.x < 0.0098 && place.z > 2 * kRadius && place.z < 0.0098;
    if (inside && there.distance > 1.001 * kRadius && there.distance < 1.1 * kRadius)
      return {place, there.normal};
  }
}

Vec3 direction(Uniform& uniform) {
  for (;;) {
    const Vec3 d{2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
    if (norm(d) < 1 && norm(d) > 0.1) return (1 / norm(d)) * d;
  }
}

/// Balance of a hit. Errors: what the body gets less what the grain loses, over the impulse, and
/// over it times 1 mm. The grain afterwards: its speed [m/s], and the change of its spin [1/s].
struct Balance {
  Real impulse_error = 0, torque_error = 0, speed_after = 0, spun_up = 0;
};

Balance balance_of(Hit hit, const Body& body) {
  const GrainKinematics before = hit.bench.grain(1);
  Vec3 given, turned;
  bool has_touched = false;
  for (int step = 0; step < 20000; ++step) {
    hit.bench.advance(4, 2e-8);
    const BodyLoad load = hit.bench.solver.body_loads()[0].load;
    given += Real(8e-8) * load.force;
    turned += Real(8e-8) * load.torque;
    if (has_touched && !touches_body(hit.bench)) break;
    has_touched = has_touched || touches_body(hit.bench);
  }
  EXPECT_TRUE(has_touched);
  const GrainKinematics after = hit.bench.grain(1);
  const auto momentum = [&](const GrainKinematics& k) {
    return k.m * cross(body.from_foot(k.x), k.u) + 0.4 * k.m * k.r * k.r * k.omega;
  };
  const Vec3 lost = before.m * (before.u - after.u);
  const Vec3 lost_turning = momentum(before) - momentum(after);
  return {norm(given - lost) / norm(lost), norm(turned - lost_turning) / (norm(lost) * 1e-3),
          norm(after.u), norm(after.omega - before.omega)};
}

// Head-on against any place, edges among them: the restitution is that of the wall, a hit takes as
// long as Hertz's without loss, and the body gets what the grain loses.
TEST(HitsOnBodies, AGrainComesOffWithTheRestitutionOfTheWall) {
  for (const BodyConfig& shape : all_shapes()) {
    for (const Real restitution : {1.0, 0.6}) {
      const Solid solid(shape, material(0, restitution));
      Uniform uniform(7);
      Real worst = 0, not_given = 0, not_turned = 0;
      for (int n = 0; n < 40; ++n) {
        const auto [x, normal] = place_near(solid, uniform);
        const Balance hit = balance_of({solid.config, x, -0.2 * normal, {}, normal}, solid.body);
        worst = std::max(worst, std::abs(hit.speed_after / 0.2 - restitution));
        not_given = std::max(not_given, hit.impulse_error);
        not_turned = std::max(not_turned, hit.torque_error);
      }
      const std::string claim = shape.name + ", e = " + std::to_string(restitution).substr(0, 3);
      expect_below(claim + ", restitution off by", worst, 2e-4);
      expect_below(claim + ", impulse on the body off by", not_given, 1e-12);
      expect_below(claim + ", and its torque over 1 mm", not_turned, 1e-10);
    }
  }
}

// Oblique hits of turning grains with sliding and rolling friction.
TEST(HitsOnBodies, TheBodyGetsWhatAGrainThatSlidesAndRollsLoses) {
  for (const BodyConfig& shape : all_shapes()) {
    const Solid solid(shape, material(0.5, 0.8, 0.3));
    Uniform uniform(11);
    Real not_given = 0, not_turned = 0, least_spun_up = 1e9;
    for (int n = 0; n < 5; ++n) {
      const auto [x, normal] = place_near(solid, uniform);
      const Vec3 aside = cross(normal, direction(uniform)), omega = 1000 * direction(uniform);
      const Balance hit =
          balance_of({solid.config, x, 0.1 * aside - 0.2 * normal, omega, normal}, solid.body);
      not_given = std::max(not_given, hit.impulse_error);
      not_turned = std::max(not_turned, hit.torque_error);
      least_spun_up = std::min(least_spun_up, hit.spun_up);
    }
    EXPECT_GT(least_spun_up, 1) << "friction turns it";
    expect_below(shape.name + ", oblique, impulse on the body off by", not_given, 1e-12);
    expect_below(shape.name + ", and its torque over 1 mm", not_turned, 1e-10);
  }
}

// Hertz (1882): 2.9432 (m^2 / (R_eff E*^2 (16/15)^2 v))^(1/5) with k = 4/3 E* sqrt(R_eff).
TEST(HitsOnBodies, AHitTakesAsLongAsHertzSays) {
  for (const std::size_t which : {std::size_t{3}, std::size_t{5}}) {
    BodyConfig shape = all_shapes()[which];
    if (shape.shape.is<shapes::Sphere>()) shape.radius = 2 * kRadius;
    const Config config = with_bodies(material(0, 1), {shape});
    const Real top = body_extent(shape, config.size).high[1], speed = 0.1, dt = 5e-9;
    Hit hit(config, {0.005, top + 1.01 * kRadius, 0.005}, {0, -speed, 0}, {}, {0, 1, 0});
    int steps = 0;
    Real deepest = 0;
    for (int n = 0; n < 40000; ++n) {
      hit.bench.advance(1, dt);
      steps += touches_body(hit.bench) ? 1 : 0;
      deepest = std::max(deepest, top + kRadius - hit.bench.grain(1).x.y);
    }
    const bool round = shape.shape.is<shapes::Sphere>();
    const Real r_eff = round ? kRadius * shape.radius / (kRadius + shape.radius) : kRadius;
    const Real stiffness = Real(4) / 3 * e_eff(config) * std::sqrt(r_eff);
    const Real m = hit.bench.grain(1).m;
    const Real depth = std::pow(Real(1.25) * m * speed * speed / stiffness, 0.4);
    expect_relative(shape.name + ", deepest", deepest, depth, 1e-4);
    expect_relative(shape.name + ", contact time", steps * dt, 2.94326 * depth / speed, 3e-3);
  }
}

// Oblique hits of turning grains, also at edges: they never come off with more energy than they
// came with; without loss and friction with the same.
TEST(HitsOnBodies, NoHitGivesEnergy) {
  for (const BodyConfig& shape : all_shapes()) {
    for (const bool lossless : {true, false}) {
      const Solid solid(shape, lossless ? material(0, 1) : material(0.5, 0.8, 0.1));
      Uniform uniform(11);
      Real gain = 0, loss = 0;
      int hits = 0;
      for (int n = 0; n < 80; ++n) {
        const auto [x, normal] = place_near(solid, uniform);
        Vec3 u = 0.2 * direction(uniform);
        if (dot(u, normal) > 0) u = -u;
        if (dot(u, normal) > -0.04) continue;
        Hit hit(solid.config, x, u, lossless ? Vec3{} : 1500 * direction(uniform), normal);
        const Real before = energy(hit.bench.grain(1));
        if (!hit.leaves(2e-8)) continue;
        ++hits;
        const Real change = energy(hit.bench.grain(1)) / before - 1;
        gain = std::max(gain, change);
        loss = std::max(loss, -change);
      }
      const std::string claim = shape.name + (lossless ? ", lossless" : ", with loss");
      EXPECT_GT(hits, 40);
      expect_below(claim + ", energy gained", gain, lossless ? 1e-5 : 1e-9);
      if (lossless) expect_below(claim + ", energy lost", loss, 1e-5);
      if (!lossless) {
        EXPECT_GT(loss, 0.1);
      }
    }
  }
}

// The crest of a dune is a point where its slopes meet.
TEST(HitsOnBodies, TheCrestOfADuneGivesNoEnergy) {
  const BodyConfig shape = all_shapes()[7];
  const Config config = with_bodies(material(0, 1), {shape});
  const Body body = make_bodies(config.bodies, config.size).body[0];
  Uniform uniform(5);
  Real change = 0;
  int hits = 0;
  for (int n = 0; n < 150; ++n) {
    const Vec3 above{0.005 + 2 * kRadius * (uniform() - 0.5), shape.height + 1.5 * kRadius,
                     0.005 + 2 * kRadius * (uniform() - 0.5)};
    const ToSurface at = body.to_surface(above);
    const Vec3 x = above + (1.02 * kRadius - at.distance) * at.normal;
    Vec3 u = 0.2 * direction(uniform);
    if (dot(u, at.normal) > 0) u = -u;
    if (dot(u, at.normal) > -0.04) continue;
    Hit hit(config, x, u, {}, at.normal);
    const Real before = energy(hit.bench.grain(1));
    if (!hit.leaves(2e-8)) continue;
    ++hits;
    change = std::max(change, std::abs(energy(hit.bench.grain(1)) / before - 1));
  }
  EXPECT_GT(hits, 80);
  expect_below("energy changed at the crest", change, 1e-5);
}

}  // namespace
}  // namespace barchan
