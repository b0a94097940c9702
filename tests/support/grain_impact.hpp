// Central impacts through the solver: a pair head-on, or a grain on a wall.
#pragma once

#include <algorithm>

#include "tests/support/grain_bench.hpp"

namespace barchan::testing {

struct ImpactCase {
  Material material;
  Real wall_modulus = 0;  // [Pa]; used with on_wall
  Real density = 2500, radius = 1e-4;
  Real v = 0;  // speed of approach [m/s]
  bool on_wall = false;

  Real e_eff() const {
    const Elastic grain{.youngs_modulus = material.youngs_modulus,
                        .poisson_ratio = material.poisson_ratio};
    Elastic other = grain;
    if (on_wall) other.youngs_modulus = wall_modulus;
    return effective_youngs_modulus(grain, other);
  }
  Real r_eff() const { return on_wall ? radius : radius / 2; }
  Real m_eff() const { return sphere_volume(radius) * density / (on_wall ? 1 : 2); }
};

/// What one step of a contact shows.
struct ImpactSample {
  Real overlap = 0, force = 0;  // [m], [N]
};

struct ImpactResult {
  Real max_overlap = 0, max_force = 0;  // largest of the steps' ends [m], [N]
  Real duration = 0, restitution = 0;   // [s], [-]
  std::vector<ImpactSample> loading;    // until the largest overlap
};

/// Speeds and gaps of the two sides of a central impact.
class CentralImpact {
 public:
  CentralImpact(const ImpactCase& c, Real gap) : case_(c), bench_(config(c), grains(c, gap)) {}

  void advance(Real dt) { bench_.advance(1, dt); }
  /// Distance of the surfaces, negative as they overlap [m].
  Real gap() const {
    if (case_.on_wall) return bench_.grain(1).x.y - case_.radius;
    return bench_.grain(2).x.x - bench_.grain(1).x.x - 2 * case_.radius;
  }
  /// Speed of separation [m/s].
  Real speed() const {
    if (case_.on_wall) return bench_.grain(1).u.y;
    return bench_.grain(2).u.x - bench_.grain(1).u.x;
  }
  /// Repulsion [N].
  Real force() const {
    return case_.on_wall ? bench_.contact_force(1).y : bench_.contact_force(2).x;
  }

 private:
  static Config config(const ImpactCase& c) {
    Config config = bench_config(c.material, c.density, c.radius);
    if (c.on_wall) config.grains->wall.youngs_modulus = c.wall_modulus;
    return config;
  }
  static InitialGrains grains(const ImpactCase& c, Real gap) {
    InitialGrains g;
    const Real r = c.radius;
    if (c.on_wall) {
      add_grain(g, 2 * r, {50 * r, r + gap, 50 * r}, {0, -c.v, 0});
    } else {
      add_grain(g, 2 * r, {50 * r, 50 * r, 50 * r}, {c.v / 2, 0, 0});
      add_grain(g, 2 * r, {52 * r + gap, 50 * r, 50 * r}, {-c.v / 2, 0, 0});
    }
    return g;
  }

  ImpactCase case_;
  GrainBench bench_;
};

/// One impact at a constant step; the surfaces meet after (1 + phase) steps of free flight.
inline ImpactResult run_impact(const ImpactCase& c, Real dt, Real phase = 0.5) {
  CentralImpact impact(c, (1 + phase) * dt * c.v);
  const Real touch = impact.gap() / c.v;  // free flight is exact
  ImpactResult result;
  bool touched = false;
  for (int n = 1; n < 2000000; ++n) {
    impact.advance(dt);
    const Real gap = impact.gap();
    if (gap < 0) {
      touched = true;
      const ImpactSample sample{-gap, impact.force()};
      if (sample.overlap > result.max_overlap) result.loading.push_back(sample);
      result.max_overlap = std::max(result.max_overlap, sample.overlap);
      result.max_force = std::max(result.max_force, sample.force);
    } else if (touched) {
      result.restitution = impact.speed() / c.v;
      result.duration = n * dt - gap / impact.speed() - touch;
      return result;
    }
  }
  ADD_FAILURE() << "the surfaces never parted";
  return result;
}

}  // namespace barchan::testing
