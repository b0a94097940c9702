// Packings through the solver: energy, friction's limit, and rest.
#include <algorithm>

#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kG = 9.81;  // [m/s^2]

/// Periodic in x and z, floor and lid; sized for a few hundred grains.
Config packing_config(Real height) {
  Config config = grain_config();
  config.size = {0.0012, height, 0.0012};
  config.grains->boundary_x = GrainBoundaryX::periodic;
  return config;
}

/// Kinetic and elastic energy, (8/15) E sqrt(R) delta^(5/2) per contact (Hertz) [J].
Real mechanical_energy(const HostGrains& h, Real e_eff, const std::array<double, 3>& size) {
  const PeriodicBox box{.lx = size[0], .lz = size[2]};
  const auto elastic = [e_eff](Real r_eff, Real delta) {
    return 8.0 / 15 * e_eff * std::sqrt(r_eff) * std::pow(delta, 2.5);
  };
  Real sum = h.kinetic_energy();
  h.for_contacts([&](int p) {
    const GrainKinematics &a = h.kin(h.i(p)), &b = h.kin(h.j(p));
    const Real overlap = a.r + b.r - norm(box.nearest_image(a.x - b.x));
    sum += elastic(effective_pair(a.r, b.r, a.m, b.m).r, std::max(Real(0), overlap));
  });
  for (int g = 0; g < h.n; ++g) {
    for (const Real gap : {h.kin(g).x.y, size[1] - h.kin(g).x.y}) {
      sum += elastic(h.kin(g).r, std::max(Real(0), h.kin(g).r - gap));
    }
  }
  return sum;
}

TEST(GrainEnergy, ConstantWithoutDampingAndFriction) {
  Config config = packing_config(0.0012);
  config.grains->material.restitution = 1;
  config.grains->material.sliding_friction = 0;
  config.grains->wall = config.grains->material;
  GrainBench bench(config, lattice_packing(60, config.size, 0.2));
  const Elastic e{.youngs_modulus = 5e6, .poisson_ratio = 0.45};
  const Real e_eff = effective_youngs_modulus(e, e);
  const Real before = mechanical_energy(HostGrains(bench.state), e_eff, config.size);
  Real worst = 0;
  std::int64_t contacts = 0;
  for (int n = 0; n < 1000; ++n) {  // 1e5 steps of 1/300 of a contact
    bench.advance(100, 1e-7);
    const Real now = mechanical_energy(HostGrains(bench.state), e_eff, config.size);
    worst = std::max(worst, std::abs(now / before - 1));
    contacts += bench.solver.contacts(bench.state).n_contacts;
  }
  EXPECT_GT(contacts, 1000) << "grains must collide";
  expect_absolute("energy drift in 1e5 steps", worst, 0, 1e-3);
}

/// Largest |F_t|/(mu |F_n|) of the pairs in contact and of grains on the floor.
struct ConeUse {
  Real pairs = 0, walls = 0;
  std::int64_t n_pairs = 0, n_outside = 0, n_sliding = 0;
};

void add_cone_use(const HostGrains& h, const PeriodicBox& box, Real mu, ConeUse& use) {
  h.for_contacts([&](int p) {
    const Vec3 s = box.nearest_image(h.kin(h.i(p)).x - h.kin(h.j(p)).x);
    const Vec3 normal = (1 / norm(s)) * s;
    const Real f_n = dot(h.force(p), normal);
    const Real part = norm(h.force(p) - f_n * normal) / (mu * std::abs(f_n));
    use.pairs = std::max(use.pairs, part);
    use.n_outside += part > 1 + 1e-9;
    use.n_sliding += part > 1 - 1e-9;
    ++use.n_pairs;
  });
  constexpr Real kRoundOff = 1e-18;  // [N], of the difference that gives the floor's force
  const auto walls = h.wall_forces();
  for (int g = 0; g < h.n; ++g) {
    if (h.wall_touching(g) == 0) continue;
    const Vec3& f = walls[static_cast<std::size_t>(g)];
    use.walls = std::max(use.walls, std::hypot(f.x, f.z) / (mu * std::abs(f.y) + kRoundOff));
  }
}

/// Weight and a force along x that grows with height.
void set_shear(const GrainState& s) {
  const auto force = s.fluid.explicit_force;
  const auto rows = s.kin;
  Kokkos::parallel_for(
      "test: shear", s.n, KOKKOS_LAMBDA(int p) {
        force(p) = rows(p).m * Vec3{kG * (0.3 + 600 * rows(p).x.y), -kG, 0};
      });
}

// A bed under gravity dragged along x by a force that grows with height; restitution 0.1.
TEST(CoulombCone, IsNeverLeftInAShearedPacking) {
  for (const RollingModel model : {RollingModel::of<NoRolling>(), RollingModel::of<Epsd2>()}) {
    Config config = packing_config(0.004);
    config.grains->material.sliding_friction = 0.4;
    config.grains->material.rolling_friction = 0.1;
    config.grains->rolling_model = model;
    config.grains->wall = config.grains->material;
    GrainBench bench(config, lattice_packing(150, config.size, 0.05));
    ConeUse use;
    for (int n = 0; n < 2000; ++n) {
      set_shear(bench.state);
      bench.advance(5, 2.5e-6);
      add_cone_use(HostGrains(bench.state), {.lx = config.size[0], .lz = config.size[2]}, 0.4, use);
    }
    EXPECT_GT(use.n_pairs, 50000);
    EXPECT_GT(use.n_sliding, use.n_pairs / 100) << "some must slide";
    std::printf("[ measured ] contacts seen %ld, sliding %ld, outside the cone %ld\n",
                static_cast<long>(use.n_pairs), static_cast<long>(use.n_sliding),
                static_cast<long>(use.n_outside));
    print_measured("largest |F_t|/(mu |F_n|) of pairs", use.pairs, 1, 1e-9);
    print_measured("largest |F_t|/(mu |F_n|) of walls", use.walls, 1, 1e-9);
    EXPECT_LE(use.pairs, 1 + 1e-9) << use.n_outside << " of " << use.n_pairs << " contacts";
    EXPECT_LE(use.walls, 1 + 1e-9);
  }
}

/// Largest kinetic energy of a grain [J] and imbalance of a grain's forces over its weight.
struct Unrest {
  Real energy = 0, imbalance = 0;
};

Unrest unrest(const HostGrains& h) {
  Unrest u;
  for (int g = 0; g < h.n; ++g) {
    const GrainKinematics& k = h.kin(g);
    const Vec3 net = h.contact_force(g) + k.m * Vec3{0, -kG, 0};
    u.energy = std::max(u.energy, kinetic_energy(k));
    u.imbalance = std::max(u.imbalance, norm(net) / (k.m * kG));
  }
  return u;
}

/// Settles for `time` [s] with a drag and a torque that stop a grain within `relaxation` [s].
void settle(GrainBench& bench, Real time, Real relaxation) {
  const int every = 20;
  const Real dt = 2.5e-6, factor = std::exp(-every * dt / relaxation);
  set_viscous_damping(bench.state, relaxation);
  for (int n = 0; n < static_cast<int>(time / dt); n += every) {
    bench.advance(every, dt);
    const auto kin = bench.state.kin;
    Kokkos::parallel_for(
        "test: viscous torque", bench.state.n,
        KOKKOS_LAMBDA(int p) { kin(p).omega = factor * kin(p).omega; });
  }
  set_viscous_damping(bench.state, 0);
}

// 250 grains as a bed without sides, or as a heap on the open floor; rolling friction
// 0.1. They fall in a viscous liquid, come to rest without it, and are stopped by it once more:
// spin about the vertical would go on forever, as contacts have no torsion.
void expect_still(const std::string& name, const Config& config, const InitialGrains& grains) {
  GrainBench bench(config, grains);
  set_weight(bench.state, {0, -kG, 0});
  settle(bench, 0.02, 2e-3);
  bench.advance(48000, 2.5e-6);
  settle(bench, 0.01, 2e-4);
  bench.advance(4000, 2.5e-6);
  // The liquid may stop a grain where it cannot stay: it then rolls off, and must come to rest.
  for (int n = 0; n < 100 && unrest(HostGrains(bench.state)).imbalance > 1e-7; ++n)
    bench.advance(4000, 2.5e-6);
  Unrest worst;
  Real floor_error = 0;
  for (int n = 0; n < 100; ++n) {  // 0.1 s
    bench.advance(400, 2.5e-6);
    const HostGrains h(bench.state);
    const Unrest now = unrest(h);
    worst.energy = std::max(worst.energy, now.energy);
    worst.imbalance = std::max(worst.imbalance, now.imbalance);
    Real carried = 0, weight = 0;
    for (const Vec3& f : h.wall_forces()) carried += f.y;
    for (int g = 0; g < h.n; ++g) weight += kG * h.kin(g).m;
    floor_error = std::max(floor_error, std::abs(carried / weight - 1));
  }
  EXPECT_GT(bench.solver.contacts(bench.state).n_contacts, 300) << "it is a pile";
  expect_absolute(name + ", kinetic energy of a grain [J]", worst.energy, 0, 1e-18);
  expect_absolute(name + ", floor force over weight - 1", floor_error, 0, 1e-6);
  expect_absolute(name + ", imbalance of a grain over its weight", worst.imbalance, 0, 1e-6);
}

Config rough_config(Real width) {
  Config config = packing_config(0.01);
  config.size[0] = config.size[2] = width;
  config.grains->material.rolling_friction = 0.1;
  config.grains->wall = config.grains->material;
  return config;
}

TEST(StaticPile, BedKeepsStill) {
  const Config config = rough_config(0.0019);
  expect_still("bed", config, lattice_packing(250, config.size, 0.01));
}

// The floor is rougher than the grains: they would roll off a smooth one one by one.
TEST(StaticPile, HeapKeepsStillNightly) {
  Config config = rough_config(0.0019);
  InitialGrains grains = lattice_packing(250, config.size, 0.01);
  config.size[0] = config.size[2] = 0.01;
  config.grains->wall.sliding_friction = 1;
  config.grains->wall.rolling_friction = 0.5;
  for (Vec3& x : grains.x) x += Vec3{0.004, 0, 0.004};
  expect_still("heap", config, grains);
}

}  // namespace
}  // namespace barchan
