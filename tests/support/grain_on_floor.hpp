// A sphere on the floor under gravity, which may be tilted to make the floor a slope.
#pragma once

#include "tests/support/grain_bench.hpp"

namespace barchan::testing {

inline constexpr Real kG = 9.81;  // [m/s^2]

struct OnFloor {
  Real radius = 0, density = 0;
  Config config;

  OnFloor(const Material& material, Real r, Real rho)
      : radius(r), density(rho), config(bench_config(material, rho, r)) {
    config.size[0] = 1000 * r;
    config.grains->boundary_x = GrainBoundaryX::periodic;
  }
  Real mass() const { return sphere_volume(radius) * density; }
  HertzMindlin law() const {
    const Elastic e{.youngs_modulus = config.grains->material.youngs_modulus,
                    .poisson_ratio = config.grains->material.poisson_ratio};
    return {.e_eff = effective_youngs_modulus(e, e), .g_eff = effective_shear_modulus(e, e)};
  }
  /// Overlap that carries a normal force [m].
  Real overlap_under(Real force) const {
    return std::pow(3 * force / (4 * law().e_eff * std::sqrt(radius)), 2.0 / 3);
  }
  /// The sphere in equilibrium along y, with velocity u and spin about z.
  GrainBench start(Real u, Real omega, Real slope = 0) const {
    const Real weight = mass() * kG * std::cos(slope);
    InitialGrains g;
    add_grain(g, 2 * radius, {20 * radius, radius - overlap_under(weight), 50 * radius}, {u, 0, 0},
              {0, 0, omega});
    GrainBench bench(config, g);
    set_weight(bench.state, {kG * std::sin(slope), -kG * std::cos(slope), 0});
    Kokkos::deep_copy(bench.state.contact_force, Vec3{0, weight, 0});  // balanced from the start
    return bench;
  }
};

/// A stiff material: overlaps of 1e-4 radii.
inline Material stiff(Real mu, Real mu_r, Real restitution = 0.1) {
  return {.youngs_modulus = 1e8,
          .poisson_ratio = 0.3,
          .restitution = restitution,
          .sliding_friction = mu,
          .rolling_friction = mu_r};
}

}  // namespace barchan::testing
