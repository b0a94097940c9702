// The integrator's order, and contact history across list rebuilds, sorting and periodic borders.
#include <algorithm>

#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using namespace test;

/// A pair that starts to touch at t = 0 and stays in contact: state of grain 1 at 0.6 contact times
/// after n steps. Sticking (mu = 10), so that the contact is smooth.
GrainKinematics in_contact(Real restitution, const Vec3& u, const Vec3& omega, int n) {
  Config config = grain_config();
  config.grains->material.restitution = restitution;
  config.grains->material.sliding_friction = 10;
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.005, 0.005}, u, omega);
  add_grain(g, 2e-4, {0.0052, 0.005, 0.005}, -u);
  GrainBench bench(config, g);
  bench.advance(n, 0.6 * 4.0e-5 / n);
  EXPECT_GT(norm(bench.contact_force(1)), 0);
  return bench.grain(1);
}

/// Observed order between n and 2 n steps, errors against many more steps.
struct Order {
  Real position = 0, velocity = 0, spin = 0;
};

Order observed_order(Real restitution, const Vec3& u, const Vec3& omega, int n) {
  const GrainKinematics exact = in_contact(restitution, u, omega, 256 * n);
  const GrainKinematics coarse = in_contact(restitution, u, omega, n);
  const GrainKinematics fine = in_contact(restitution, u, omega, 2 * n);
  const auto order = [](const Vec3& c, const Vec3& f, const Vec3& e) {
    return std::log2(norm(c - e) / norm(f - e));
  };
  return {order(coarse.x, fine.x, exact.x), order(coarse.u, fine.u, exact.u),
          order(coarse.omega, fine.omega, exact.omega)};
}

const Vec3 kHeadOn{0.05, 0, 0}, kOblique{0.05, 0.01, 0.005}, kSpin{20, -30, 60};

TEST(IntegratorOrder, TwoInElasticNormalContact) {
  for (const int n : {64, 256}) {  // 1/107 and 1/427 of the contact
    const Order order = observed_order(1, kHeadOn, {}, n);
    expect_absolute("order, elastic head-on, position", order.position, 2, 0.1);
    expect_absolute("order, elastic head-on, velocity", order.velocity, 2, 0.1);
  }
}

// The dashpot sees the velocity of half a step before: first order.
TEST(IntegratorOrder, OneWithDamping) {
  const Order damped = observed_order(0.5, kOblique, kSpin, 64);
  expect_absolute("order, damped, position", damped.position, 1, 0.1);
  expect_absolute("order, damped, velocity", damped.velocity, 1, 0.1);
}

// The slip is that of the velocities of half a step before across the new normal, which turns as
// the pair rolls: a small first-order part remains beside the second-order one.
TEST(IntegratorOrder, BetweenOneAndTwoInObliqueContact) {
  for (const int n : {64, 256}) {
    const Order oblique = observed_order(1, kOblique, kSpin, n);
    const Real error =
        norm(in_contact(1, kOblique, kSpin, n).u - in_contact(1, kOblique, kSpin, 256 * n).u) /
        norm(kOblique);
    print_measured("order, elastic oblique, position", oblique.position, 2, 1);
    print_measured("order, elastic oblique, velocity", oblique.velocity, 2, 1);
    expect_absolute("relative error of its velocity", error, 0, 1.0 / (n * n) + 2e-3 / n);
    EXPECT_GT(oblique.position, 0.9);
    EXPECT_GT(oblique.velocity, 0.9);
  }
}

/// A bed in motion under gravity with rolling springs; what changes nothing in its motion is
/// varied.
struct Variant {
  Real skin = 4e-5;       // [m]
  Vec3 shift = {};        // of all grains, around the periodic box [m]
  bool reversed = false;  // order of the initial rows
};

constexpr Real kWidth = 0.0012;

std::vector<GrainRow> move_bed(const Variant& v, std::int64_t& rebuilds) {
  Config config = grain_config();
  config.size = {kWidth, 0.003, kWidth};
  config.grains->boundary_x = GrainBoundaryX::periodic;
  config.grains->material.rolling_friction = 0.1;
  config.grains->wall = config.grains->material;
  config.grains->skin = v.skin;
  InitialGrains grains = lattice_packing(64, config.size, 0.05);
  const PeriodicBox box{.lx = kWidth, .lz = kWidth};
  for (Vec3& x : grains.x) x = box.wrap(x + v.shift);
  for (Vec3& u : grains.u) u += Vec3{0.3, 0, 0.2};  // across the borders
  if (v.reversed) {
    std::reverse(grains.id.begin(), grains.id.end());
    std::reverse(grains.diameter.begin(), grains.diameter.end());
    std::reverse(grains.x.begin(), grains.x.end());
    std::reverse(grains.u.begin(), grains.u.end());
  }
  GrainBench bench(config, grains);
  set_weight(bench.state, {0, -500, 0});  // packs within a millisecond
  bench.advance(600, 2.5e-6);
  EXPECT_GT(bench.solver.contacts(bench.state).n_contacts, 15);
  rebuilds = bench.solver.list().rebuilds();
  return rows_by_id(bench.state);
}

/// Largest distance of grains between two variants, in diameters, and of spins, of the largest.
void expect_same_motion(const std::string& claim, const Variant& v) {
  std::int64_t rare = 0, now = 0;
  const auto plain = move_bed({}, rare), other = move_bed(v, now);
  Real distance = 0, spin = 0, largest_spin = 0;
  const auto wrapped = [](Real s) { return s - kWidth * std::round(s / kWidth); };
  for (std::size_t id = 1; id < plain.size(); ++id) {
    const Vec3 s = other[id].x - plain[id].x - v.shift;
    distance = std::max(distance, norm(Vec3{wrapped(s.x), s.y, wrapped(s.z)}) / 2e-4);
    spin = std::max(spin, norm(other[id].omega - plain[id].omega));
    largest_spin = std::max(largest_spin, norm(plain[id].omega));
  }
  std::printf("[ measured ] rebuilds: %ld and %ld\n", static_cast<long>(rare),
              static_cast<long>(now));
  EXPECT_GT(now, v.skin < 1e-5 ? 4 * rare : 5);
  EXPECT_GT(largest_spin, 10);
  expect_absolute(claim + ", positions over diameters", distance, 0, 1e-8);
  expect_absolute(claim + ", spins over the largest", spin / largest_spin, 0, 1e-6);
}

// Forces are summed in another order, so that the motions agree up to round-off, which collisions
// amplify; a history lost once changes them by percents.
TEST(ContactHistory, SurvivesRebuilds) {
  expect_same_motion("ten times the rebuilds", {.skin = 4e-6});
}

TEST(ContactHistory, SurvivesSorting) { expect_same_motion("rows reversed", {.reversed = true}); }

TEST(ContactHistory, SurvivesPeriodicBorders) {
  expect_same_motion("borders elsewhere", {.shift = {0.41 * kWidth, 0, 0.57 * kWidth}});
}

}  // namespace
}  // namespace barchan
