// Bodies of all shapes in a box for grains that tests share.
#pragma once

#include <vector>

#include "src/bodies/body_extent.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan::test {

inline constexpr Real kG = 9.81;       // [m/s^2]
inline constexpr Real kRadius = 1e-4;  // of a grain [m]

inline Material material(Real mu, Real restitution, Real mu_r = 0) {
  return {.youngs_modulus = 1e8,
          .poisson_ratio = 0.3,
          .restitution = restitution,
          .sliding_friction = mu,
          .rolling_friction = mu_r};
}

/// A box of 10 mm with these bodies, without gravity.
inline Config with_bodies(const Material& m, const std::vector<BodyConfig>& bodies) {
  Config config = bench_config(m, 2500, kRadius);
  config.bodies = bodies;
  return config;
}

/// A body of each shape, above the floor where it can be.
inline std::vector<BodyConfig> all_shapes() {
  using S = BodyShape;
  const std::array<double, 2> at{0.005, 0.005};
  return {{.name = "post",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .radius = 1e-3,
           .height = 2e-3},
          {.name = "along x",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .base = 1e-3,
           .axis = Axis::x,
           .radius = 1e-3,
           .length = 3e-3},
          {.name = "along z",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .base = 1e-3,
           .axis = Axis::z,
           .radius = 1e-3,
           .length = 3e-3},
          {.name = "sphere",
           .shape = S::of<shapes::Sphere>(),
           .centre = at,
           .base = 1e-3,
           .radius = 1e-3},
          {.name = "half sphere",
           .shape = S::of<shapes::HalfSphere>(),
           .centre = at,
           .base = 1e-3,
           .radius = 1e-3},
          {.name = "box",
           .shape = S::of<shapes::Box>(),
           .centre = at,
           .base = 1e-3,
           .height = 1e-3,
           .size = {3e-3, 2e-3},
           .angle = 0.4},
          {.name = "fence",
           .shape = S::of<shapes::Fence>(),
           .centre = at,
           .radius = 5e-4,
           .height = 2e-3,
           .length = 4e-3,
           .spacing = 2e-3},
          {.name = "dune",
           .shape = S::of<shapes::Dune>(),
           .centre = at,
           .height = 1e-3,
           .size = {7e-3, 6e-3},
           .lee = 2e-3},
          {.name = "wave",
           .shape = S::of<shapes::Wave>(),
           .centre = {0.005, 0},
           .height = 1e-3,
           .wavelength = 5e-3}};
}

inline Real e_eff(const Config& config) {
  const Elastic e{.youngs_modulus = config.grains->material.youngs_modulus,
                  .poisson_ratio = config.grains->material.poisson_ratio};
  return effective_youngs_modulus(e, e);
}

/// Kinetic energy of a grain [J].
inline Real energy(const GrainKinematics& k) {
  return k.m * (dot(k.u, k.u) + 0.4 * k.r * k.r * dot(k.omega, k.omega)) / 2;
}

inline bool touches_body(const GrainBench& bench) {
  return host_copy(bench.state.body_touching)(0) != 0;
}

}  // namespace barchan::test
