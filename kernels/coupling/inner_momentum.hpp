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

/// Sums over a row of faces inside a grain, with x the distance from the centre along it.
struct RowSums {
  Real w = 0, x = 0, xx = 0, u = 0, xu = 0;
};

/// Sums over all faces inside a grain: x with a = y, b = z; y with a = z, b = x; z with a = x, b =
/// y.
struct InnerSums {
  FaceSums x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION InnerSums& operator+=(const InnerSums& more) {
    x += more.x, y += more.y, z += more.z;
    return *this;
  }
  /// Adds a row of the faces of a direction, at y and z from the centre.
  KOKKOS_INLINE_FUNCTION void add_row(int direction, Real off_y, Real off_z, const RowSums& row) {
    if (direction == 0) {
      x += {row.w, off_y * row.w, off_z * row.w, off_y * off_y * row.w, off_z * off_z * row.w,
            row.u, off_y * row.u, off_z * row.u};
    } else if (direction == 1) {
      y += {row.w,  off_z * row.w, row.x,         off_z * off_z * row.w,
            row.xx, row.u,         off_z * row.u, row.xu};
    } else {
      z += {row.w, row.x,  off_y * row.w, row.xx, off_y * off_y * row.w,
            row.u, row.xu, off_y * row.u};
    }
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

  KOKKOS_INLINE_FUNCTION void operator()(const GrainKinematics& grain, const PatchCorner& corner,
                                         int row, InnerSums& sums) const {
    const int direction = row / (patch.n[1] * patch.n[2]);
    const GridRef& grid = patch.grid;
    const auto from_centre = [&](int axis, int index, Real spacing, Real centre) {
      return (index + (axis == direction ? Real(0) : Real(0.5))) * spacing - centre;
    };
    const int b = row % patch.n[1], c = row / patch.n[1] % patch.n[2];
    const Real y = from_centre(1, corner.of(1, direction) + b, grid.dy(0), grain.x.y);
    const Real z = from_centre(2, corner.of(2, direction) + c, grid.dz, grain.x.z);
    const Real first = from_centre(0, corner.of(0, direction), grid.dx, grain.x.x);
    const Real per_width = Kokkos::cbrt(patch.per_cell.x * patch.per_cell.y * patch.per_cell.z);
    const Real off_axis = y * y + z * z, outer = grain.r + 1 / per_width;
    if (off_axis > outer * outer) return;
    const ConstFieldRef& of = direction == 0 ? u.x : direction == 1 ? u.y : u.z;
    patch.each_run(corner, row, [&](int at, int i, int j, int k, int n) {
      const Real* const velocity = &of(i, j, k);
      const Real begin = first + (at % patch.n[0]) * grid.dx;
      Real w = 0, wx = 0, wxx = 0, wu = 0, wxu = 0;
#pragma omp simd reduction(+ : w, wx, wxx, wu, wxu)
      for (int q = 0; q < n; ++q) {
        const Real x = begin + q * grid.dx;
        const Real share = share_inside((grain.r - Kokkos::sqrt(x * x + off_axis)) * per_width);
        w += share, wx += share * x, wxx += share * x * x;
        wu += share * velocity[q], wxu += share * x * velocity[q];
      }
      sums.add_row(direction, y, z, {w, wx, wxx, wu, wxu});
    });
  }
};

/// Sums of a step over a grain: what its markers gave, and the water inside.
struct WaterOfGrain {
  ImpulseOnWater given;
  InnerSums inner;
};

/// Adds up the water inside each grain, a team per grain.
struct SumOfInside {
  using Team = Kokkos::TeamPolicy<>::member_type;
  AddInnerFaces inner;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const ImpulseOnWater*> given;
  Kokkos::View<WaterOfGrain*> water;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int g = team.league_rank();
    const GrainKinematics grain = grains(g);
    const PatchCorner corner = inner.patch.corner(grain.x);
    InnerSums sums;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, inner.patch.rows()),
        [&](int row, InnerSums& all) { inner(grain, corner, row, all); },
        Kokkos::Sum<InnerSums>(sums));
    Kokkos::single(Kokkos::PerTeam(team), [&] { water(g) = {given(g), sums}; });
  }
};

/// Sets the momentum of the water inside each grain, and with the impulse of its markers the force
/// and torque of the water outside:
///   F = -J / dt + (I - I_before) / dt.
/// With dt = 0 it only sets the momentum.
struct LoadsOnGrains {
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const WaterOfGrain*> water;
  Real density, dt;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const auto& [given, inner] = water(g);
    const Real mass = density * sphere_volume(grains(g).r);
    const Vec3 momentum = mass * inner.velocity();
    const Vec3 spin = sphere_inertia(mass, grains(g).r) * inner.spin();
    if (dt > 0) {
      exchange.resolved_force(g) =
          (1 / dt) * (momentum - exchange.inner_momentum(g) - given.linear);
      exchange.resolved_torque(g) = (1 / dt) * (spin - exchange.inner_spin(g) - given.angular);
    }
    exchange.inner_momentum(g) = momentum;
    exchange.inner_spin(g) = spin;
  }
};

/// Adds up the forces of the water on all grains [N].
struct SumOfLoads {
  Kokkos::View<const Vec3*> force;
  KOKKOS_FUNCTION void operator()(int g, Vec3& sum) const { sum += force(g); }
};

/// Hands force and torque of the water over the last fluid step to the grain steps of the next one,
/// with weight, buoyancy, and added mass and inertia: what force and torque of the water change
/// with the acceleration of the grain. Only contacts change it at once, so the mass is that there.
struct ActOnGrains {
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  ExchangeOnGrains exchange;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.explicit_force(g) = exchange.resolved_force(g) + weight(grains(g));
    const Real added_mass = kTouchingAddedMass * weight.displaced * sphere_volume(grains(g).r);
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
