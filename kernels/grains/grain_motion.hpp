// Velocity Verlet of a grain and the fluid that it carries along, with a drag that is linear in
// their slip. Equations: docs/theory-grains.md, "Integration".
#pragma once

#include "kernels/grains/half_kick.hpp"
#include "kernels/grains/list_validity.hpp"
#include "kernels/grains/sphere.hpp"
#include "kernels/grains/tile.hpp"

namespace barchan {

/// Effect of the fluid on the grains: none, a force, a force and a torque; or both of a flow that
/// is resolved around them. That flow has no velocity of its own at a grain: its slip is zero.
enum class FluidEffect { none, force, force_and_torque, resolved };
KOKKOS_FORCEINLINE_FUNCTION constexpr bool has_slip(FluidEffect effect) {
  return effect == FluidEffect::force || effect == FluidEffect::force_and_torque;
}

/// Part of velocity Verlet in one pass: half a kick and a drift before the first grain step;
/// between two grain steps a half kick of each and the drift of the second; half a kick after the
/// last.
enum class Moves { into_first, between, out_of_last };

/// The motion of the grains, a block of them at a time.
struct GrainMotion {
  Real dt = 0;
  Real elapsed = 0;  // since the fluid step began [s]
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<const Vec3*> x_reference;  // positions at the last list rebuild
  FluidOnGrains fluid;
  Kokkos::View<Real*> slack;  // as in PairList

  /// Block of grains: state and contact sums in, new state out.
  struct Tile {
    AosTile x_r, u_m, omega_skin, force, torque;
    SoaTile new_x, new_u, new_omega;
    Real excess[kTile];  // square of the displacement beyond that of the skin [m^2]
  };

  /// Moves the grains [begin, end), at most a block of them, with the sums of their contacts.
  /// Returns whether one has used up its slack; raises `largest` to their largest excess over the
  /// skin [m^2].
  template <Moves moves>
  KOKKOS_FUNCTION bool advance(int begin, int end, const ContactSum* sums, Real& largest) const {
    const int n = size_of_block(begin, end);
    Tile s;
    for (int q = 0; q < n; ++q) {
      const GrainKinematics& grain = grains(begin + q);
      s.x_r.store(q, grain.x_r()), s.u_m.store(q, grain.u_m()),
          s.omega_skin.store(q, grain.omega_skin());
      s.force.store(q, sums[q].force), s.torque.store(q, sums[q].torque);
    }
    const bool expired = !fluid.has_fluid    ? advance<moves, FluidEffect::none>(s, begin, n)
                         : fluid.is_resolved ? advance<moves, FluidEffect::resolved>(s, begin, n)
                         : fluid.has_torque
                             ? advance<moves, FluidEffect::force_and_torque>(s, begin, n)
                             : advance<moves, FluidEffect::force>(s, begin, n);
    s.new_x.to_aos(n, s.x_r), s.new_u.to_aos(n, s.u_m), s.new_omega.to_aos(n, s.omega_skin);
    for (int q = 0; q < n; ++q) {
      GrainKinematics& grain = grains(begin + q);
      grain.x = s.x_r.vec(q), grain.u = s.u_m.vec(q), grain.omega = s.omega_skin.vec(q);
      if constexpr (moves != Moves::out_of_last) largest = Kokkos::max(largest, s.excess[q]);
    }
    return expired;
  }

 private:
  template <Moves moves, FluidEffect effect>
  KOKKOS_FORCEINLINE_FUNCTION bool advance(Tile& s, int begin, int n) const {
    int expired = 0;
#pragma GCC ivdep
    for (int q = 0; q < n; ++q) expired |= advance_one<moves, effect>(s, q, begin + q);
    return expired != 0;
  }
  /// Returns 1 for a grain that has used up its slack.
  template <Moves moves, FluidEffect effect>
  KOKKOS_FORCEINLINE_FUNCTION int advance_one(Tile& s, int q, int g) const {
    Vec3 x = s.x_r.vec(q), u = s.u_m.vec(q), omega = s.omega_skin.vec(q);
    const Real radius = s.x_r.w(q), mass = s.u_m.w(q), skin = s.omega_skin.w(q);
    GrainForces f = forces<effect>(s, q, g);
    const HalfKick half_kick(dt / 2, coefficients<effect>(g, mass, radius));
    Vec3 impulse = half_kick(f, u, omega);
    if constexpr (moves == Moves::between) impulse += half_kick(f, u, omega);
    if constexpr (moves != Moves::out_of_last) x = fma(dt, u, x);
    if constexpr (effect != FluidEffect::none) fluid.impulse(g) += impulse;
    s.new_x.store(q, x, radius), s.new_u.store(q, u, mass), s.new_omega.store(q, omega, skin);
    s.excess[q] = excess_over_skin(x - x_reference(g), skin);
    if constexpr (!kOnHost || moves == Moves::into_first) return 0;
    slack(g) -= dt * norm(u);
    return slack(g) >= 0 ? 0 : 1;
  }
  template <FluidEffect effect>
  KOKKOS_FORCEINLINE_FUNCTION MotionCoefficients coefficients(int g, Real mass, Real radius) const {
    MotionCoefficients c{.mass = mass, .inertia_moment = sphere_inertia(mass, radius)};
    if constexpr (has_slip(effect)) {
      c.inv_fluid_mass = fluid.inv_fluid_mass(g);
      c.beta = fluid.beta(g);
    }
    if constexpr (effect != FluidEffect::none) c.added_mass = fluid.added_mass(g);
    if constexpr (effect == FluidEffect::force_and_torque) c.beta_r = fluid.beta_r(g);
    if constexpr (effect == FluidEffect::resolved)
      c.inertia_moment += added_inertia(c.added_mass, radius);
    return c;
  }
  template <FluidEffect effect>
  KOKKOS_FORCEINLINE_FUNCTION GrainForces forces(const Tile& s, int q, int g) const {
    GrainForces f;
    f.force = s.force.vec(q) + fluid.explicit_force(g);
    f.torque = s.torque.vec(q);
    if constexpr (has_slip(effect)) {
      f.u_f = fluid.u_f_after(elapsed, g);
      f.acceleration = fluid.acceleration(g);
    }
    if constexpr (effect == FluidEffect::force_and_torque) f.omega_f = fluid.omega_f(g);
    if constexpr (effect == FluidEffect::resolved) {
      f.u_f = s.u_m.vec(q);
      f.acceleration = fluid.acceleration(g);
      f.torque += fluid.explicit_torque(g);
    }
    return f;
  }
};

/// Starts the grain steps with the stored contact forces, a block of grains per index. Reduces the
/// largest excess of a grain over its skin [m^2].
struct KickAndDrift {
  GrainMotion motion;
  int n;
  Kokkos::View<const Vec3*> contact_force, contact_torque;

  KOKKOS_FUNCTION void operator()(int block, Real& largest) const {
    const int begin = block * kTile;
    ContactSum sums[kTile];
    for (int q = 0; q < size_of_block(begin, n); ++q) {
      sums[q] = {vec4(contact_force(begin + q)), vec4(contact_torque(begin + q))};
    }
    motion.advance<Moves::into_first>(begin, n, sums, largest);
  }
};

}  // namespace barchan
