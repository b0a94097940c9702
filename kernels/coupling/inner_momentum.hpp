// Momentum of the water inside a grain, and the force of the water outside. Equations:
// docs/theory-resolved.md.
#pragma once

#include "kernels/coupling/marker_forcing.hpp"
#include "kernels/coupling/sphere_in_fluid.hpp"

namespace barchan {

/// Share of a cell that lies within a sphere; s: distance of its centre from the surface, inwards,
/// over its width. Linear over the width of a cell.
KOKKOS_FORCEINLINE_FUNCTION Real share_inside(Real s) {
  return Kokkos::clamp(s + Real(0.5), Real(0), Real(1));
}

/// Sums over the faces of one direction inside a grain: of the volume shares w, and of w a, w b, w
/// a^2, w b^2, w u, w a u, w b u, with a and b the distances from the centre across the direction.
struct FaceSums {
  Real w = 0, a = 0, b = 0, aa = 0, bb = 0, u = 0, au = 0, bu = 0;

  KOKKOS_FORCEINLINE_FUNCTION void add(Real share, Real of_a, Real of_b, Real velocity) {
    const Real wa = share * of_a, wb = share * of_b;
    w += share, a += wa, b += wb, aa += wa * of_a, bb += wb * of_b;
    u += share * velocity, au += wa * velocity, bu += wb * velocity;
  }
  KOKKOS_FORCEINLINE_FUNCTION FaceSums& operator+=(const FaceSums& m) {
    w += m.w, a += m.a, b += m.b, aa += m.aa, bb += m.bb, u += m.u, au += m.au, bu += m.bu;
    return *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real mean() const { return u / w; }
  /// Moments about the mean: of the velocity with a, with b, and of a and b with themselves.
  KOKKOS_FORCEINLINE_FUNCTION Real with_a() const { return au - a * mean(); }
  KOKKOS_FORCEINLINE_FUNCTION Real with_b() const { return bu - b * mean(); }
  KOKKOS_FORCEINLINE_FUNCTION Real spread_a() const { return aa - a * a / w; }
  KOKKOS_FORCEINLINE_FUNCTION Real spread_b() const { return bb - b * b / w; }
};

/// Sums over all faces inside a grain: x with a = y, b = z; y with a = z, b = x; z with a = x, b =
/// y.
struct InnerSums {
  FaceSums x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION InnerSums& operator+=(const InnerSums& more) {
    x += more.x, y += more.y, z += more.z;
    return *this;
  }
  /// Mean velocity [m/s].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 velocity() const { return {x.mean(), y.mean(), z.mean()}; }
  /// Mean angular velocity [rad/s]; exact where the water turns like a solid.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 spin() const {
    return {(z.with_b() - y.with_a()) / (z.spread_b() + y.spread_a()),
            (x.with_b() - z.with_a()) / (x.spread_b() + z.spread_a()),
            (y.with_b() - x.with_a()) / (y.spread_b() + x.spread_a())};
  }
};

/// Adds up the faces inside a grain.
struct AddInnerFaces {
  GrainPatch patch;
  ConstFaceRef u;

  KOKKOS_INLINE_FUNCTION void operator()(const GrainKinematics& grain, int row,
                                         InnerSums& sums) const {
    const GridRef& grid = patch.grid;
    const Real per_width = 1 / Kokkos::cbrt(grid.cell_volume(0));
    const auto off = [](Real s, Real period) { return s - period * Kokkos::round(s / period); };
    const auto share = [&](const Vec3& s) { return share_inside((grain.r - norm(s)) * per_width); };
    patch.each_cell(grain.x, row, [&](int i, int j, int k) {
      const Vec3 c{off(grid.x_centre(i) - grain.x.x, grid.lx), grid.y_centre(j) - grain.x.y,
                   off(grid.z_centre(k) - grain.x.z, grid.lz)};
      const Real x_face = c.x - grid.dx / 2, z_face = c.z - grid.dz / 2;
      const Real y_face = grid.y_face(j) - grain.x.y;
      sums.x.add(share({x_face, c.y, c.z}), c.y, c.z, u.x(i, j, k));
      sums.y.add(share({c.x, y_face, c.z}), c.z, c.x, u.y(i, j, k));
      sums.z.add(share({c.x, c.y, z_face}), c.x, c.y, u.z(i, j, k));
    });
  }
};

/// Sets the momentum of the water inside each grain, a team per grain, and with the impulse of its
/// markers the force and torque of the water outside:
///   F = -J / dt + (I - I_before) / dt.
/// With dt = 0 it only sets the momentum.
struct LoadsOnGrains {
  using Team = Kokkos::TeamPolicy<>::member_type;
  AddInnerFaces inner;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const ImpulseOnWater*> given;
  Real density, dt;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int g = team.league_rank();
    const GrainKinematics grain = grains(g);
    InnerSums sums;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, inner.patch.rows()),
        [&](int row, InnerSums& all) { inner(grain, row, all); }, Kokkos::Sum<InnerSums>(sums));
    const Real mass = density * sphere_volume(grain.r);
    const Vec3 momentum = mass * sums.velocity();
    const Vec3 spin = sphere_inertia(mass, grain.r) * sums.spin();
    Kokkos::single(Kokkos::PerTeam(team), [&] {
      if (dt > 0) {
        exchange.resolved_force(g) =
            (1 / dt) * (momentum - exchange.inner_momentum(g) - given(g).linear);
        exchange.resolved_torque(g) = (1 / dt) * (spin - exchange.inner_spin(g) - given(g).angular);
      }
      exchange.inner_momentum(g) = momentum;
      exchange.inner_spin(g) = spin;
    });
  }
};

/// Adds up the forces of the water on all grains [N].
struct SumOfLoads {
  Kokkos::View<const Vec3*> force;
  KOKKOS_FUNCTION void operator()(int g, Vec3& sum) const { sum += force(g); }
};

/// Hands force and torque of the water over the last fluid step to the grain steps of the next one,
/// with weight, buoyancy, and added mass and inertia: what force and torque of the water change
/// with the acceleration of the grain.
struct ActOnGrains {
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  ExchangeOnGrains exchange;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.explicit_force(g) = exchange.resolved_force(g) + weight(grains(g));
    const Real added_mass = sphere_added_mass(weight.displaced, sphere_volume(grains(g).r));
    on_grains.added_mass(g) = added_mass;
    on_grains.explicit_torque(g) =
        exchange.resolved_torque(g) +
        added_inertia(added_mass, grains(g).r) * on_grains.spin_acceleration(g);
  }
};

/// Keeps the acceleration of the grains over a fluid step, from which the next one counts its
/// change.
struct KeepAcceleration {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  Real dt;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.acceleration(g) = (1 / dt) * (grains(g).u - on_grains.u_start(g));
    on_grains.spin_acceleration(g) = (1 / dt) * (grains(g).omega - on_grains.spin_start(g));
  }
};

}  // namespace barchan

template <>
struct Kokkos::reduction_identity<barchan::InnerSums> {
  KOKKOS_FORCEINLINE_FUNCTION static barchan::InnerSums sum() { return {}; }
};
