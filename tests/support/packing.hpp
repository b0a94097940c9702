// Loose packings that fill a box, and sums over all their contacts.
#pragma once

#include <array>
#include <utility>

#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan::test {

/// n grains of 0.15 to 0.25 mm on a lattice 0.27 mm wide from the floor up, with random velocities
/// of at most `speed` per component [m/s].
inline InitialGrains lattice_packing(int n, const std::array<double, 3>& size, Real speed,
                                     unsigned seed = 1) {
  Uniform uniform(seed);
  const Real pitch = 2.7e-4;
  const int nx = static_cast<int>(size[0] / pitch), nz = static_cast<int>(size[2] / pitch);
  InitialGrains grains;
  for (int g = 0; g < n; ++g) {
    const int layer = g / (nx * nz), row = g % (nx * nz);
    const Vec3 x{(row % nx + 0.5) * size[0] / nx, (layer + 0.5) * pitch,
                 (row / nx + 0.5) * size[2] / nz};
    const Real d = 1.5e-4 + 1e-4 * uniform();
    const auto component = [&] { return speed * (2 * uniform() - 1); };
    const Real u = component(), v = component(), w = component();
    add_grain(grains, d, x, {u, v, w});
  }
  return grains;
}

/// Kinetic energy of translation and rotation [J].
inline Real kinetic_energy(const GrainKinematics& k) {
  return 0.5 * k.m * dot(k.u, k.u) + 0.5 * sphere_inertia(k.m, k.r) * dot(k.omega, k.omega);
}

/// Rows, pairs and walls of a state on the host.
struct HostGrains {
  explicit HostGrains(const GrainState& s)
      : n(s.n),
        n_pairs(s.list.n_pairs),
        kin(host_copy(s.kin)),
        contact_force(host_copy(s.contact_force)),
        i(host_copy(s.list.i)),
        j(host_copy(s.list.j)),
        force(host_copy(s.list.force)),
        touching(host_copy(s.list.touching)),
        wall_touching(host_copy(s.wall_touching)) {}

  /// Calls each(pair) for the pairs in contact.
  template <class Each>
  void for_contacts(Each each) const {
    for (int p = 0; p < n_pairs; ++p) {
      if (touching(p)) each(p);
    }
  }
  /// Force of the walls on each grain: its contact force without that of the pairs [N].
  std::vector<Vec3> wall_forces() const {
    std::vector<Vec3> sum(static_cast<std::size_t>(n));
    for (int g = 0; g < n; ++g) sum[static_cast<std::size_t>(g)] = contact_force(g);
    for_contacts([&](int p) {
      sum[static_cast<std::size_t>(i(p))] += -force(p);
      sum[static_cast<std::size_t>(j(p))] += force(p);
    });
    return sum;
  }
  Real kinetic_energy() const {
    Real sum = 0;
    for (int g = 0; g < n; ++g) sum += test::kinetic_energy(kin(g));
    return sum;
  }

  int n, n_pairs;
  decltype(host_copy(GrainState().kin)) kin;
  decltype(host_copy(GrainState().contact_force)) contact_force;
  decltype(host_copy(PairList().i)) i, j;
  decltype(host_copy(PairList().force)) force;  // of config.output.grain_forces
  decltype(host_copy(PairList().touching)) touching;
  decltype(host_copy(GrainState().wall_touching)) wall_touching;
};

/// Resistance of a still liquid at rest: each grain slows down within `time` [s]; 0: none.
inline void set_viscous_damping(GrainState& s, Real time) {
  if (!s.fluid.has_fluid) add_fluid(s);
  const auto beta = s.fluid.beta;
  const auto kin = s.kin;
  const Real rate = time > 0 ? 1 / time : 0;
  Kokkos::parallel_for(
      "test: viscous damping", s.n, KOKKOS_LAMBDA(int p) { beta(p) = rate * kin(p).m; });
}

}  // namespace barchan::test
