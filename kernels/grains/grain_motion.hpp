// Velocity Verlet of a grain and the fluid that it carries along, with a drag that is linear in
// their slip; one pass over the chunks of grains per sub-step: forces of their inner pairs, sum
// of all contacts, kick, and drift into the next sub-step. Equations: docs/numerics.md, "Grains".
#pragma once

#include "kernels/grains/half_kick.hpp"
#include "kernels/grains/pair_forces.hpp"
#include "kernels/grains/wall_contact.hpp"

namespace barchan {

/// Adds what a crossing pair does to its first grain (sign 1) or second grain (-1).
KOKKOS_FORCEINLINE_FUNCTION void add_pair_force(const PairList& list, int slot, Real sign,
                                                Real radius, bool has_rolling, ContactSum& sum) {
  const PairForce& pair = list.pair_force(slot);
  sum.force = fused(sign, pair.force, sum.force);
  sum.torque = fused(pair.force.w() / 2 - radius, pair.n_cross_f_t, sum.torque);
  if (has_rolling) sum.torque = fused(sign, quad(list.rolling(slot)), sum.torque);
}

KOKKOS_FORCEINLINE_FUNCTION void fetch_pair_force(const PairList& list, int s) {
  if (s >= list.n_crossing) return;
  prefetch(list.pair_force(list.other_slot(s)));
  prefetch(list.j(list.other_slot(s)));
}

/// Sums of the crossing contacts of the rows [begin, end), of each row its own slots first, then
/// the others.
KOKKOS_FORCEINLINE_FUNCTION void sum_crossing(const PairList& list,
                                              const Kokkos::View<GrainKinematics*>& grains,
                                              int begin, int end, bool has_rolling,
                                              ContactSum* sums) {
  for (int g = begin; g < end; ++g) sums[g - begin] = ContactSum{};
  for (int p = list.first(begin); p < list.first(end); ++p) {
    const int g = list.i(p);
    add_pair_force(list, p, 1, grains(g).r, has_rolling, sums[g - begin]);
  }
  for (int s = list.other_first(begin); s < list.other_first(end); ++s) {
    if constexpr (kLargestChunk > 1) fetch_pair_force(list, s + 8);
    const int slot = list.other_slot(s), g = list.j(slot);
    add_pair_force(list, slot, -1, grains(g).r, has_rolling, sums[g - begin]);
  }
}

/// The start of the sub-steps: first half kick with the stored contact forces, then drift.
struct KickAndDrift {
  Real dt = 0;
  Real elapsed = 0;  // since the fluid step began [s]
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<Vec3*> contact_force, contact_torque;
  Kokkos::View<const Vec3*> x_reference;  // positions at the last list rebuild
  FluidOnGrains fluid;

  KOKKOS_FORCEINLINE_FUNCTION GrainForces forces(int g, const GrainKinematics& grain,
                                                 const ContactSum& contacts) const {
    GrainForces f{.force = contacts.force + quad(fluid.steady_force(g)),
                  .torque = contacts.torque,
                  .mass = grain.m,
                  .inertia_moment = sphere_inertia(grain.m, grain.r)};
    if (!fluid.none) f.add_fluid(fluid, elapsed, g);
    return f;
  }

  /// Half kick from here, then drift; returns the impulse. `largest` as below.
  KOKKOS_FORCEINLINE_FUNCTION Quad kick_and_drift(int g, const HalfKick& kick, GrainForces& f,
                                                  Quad& x, Quad& u, Quad& omega,
                                                  Real& largest) const {
    const Quad impulse = kick(f, u, omega);
    x = fused(dt, u, x);
    largest = Kokkos::max(largest, excess_over_skin(x.vec() - x_reference(g), grains(g).skin));
    return impulse;
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(int g, const Quad& x, const Quad& u, const Quad& omega,
                                         const Quad& impulse) const {
    GrainKinematics& grain = grains(g);
    grain.x = x.vec(), grain.u = u.vec(), grain.omega = omega.vec();
    if (!fluid.none) fluid.impulse(g) += impulse.vec();
  }

  /// Reduces the largest excess over the skin of a grain [m^2].
  KOKKOS_FUNCTION void operator()(int g, Real& largest) const {
    const GrainKinematics& grain = grains(g);
    Quad x = grain.x_r(), u = grain.u_m(), omega = grain.spin();
    GrainForces f =
        forces(g, grain, {.force = quad(contact_force(g)), .torque = quad(contact_torque(g))});
    const Quad impulse = kick_and_drift(g, HalfKick(dt / 2, f), f, x, u, omega, largest);
    store(g, x, u, omega, impulse);
  }
};

/// The end of a sub-step, a chunk of grains per index: new contact forces, second half kick, and
/// unless it is the last sub-step the first half kick and drift of the next one. No grain of
/// another chunk is read, so chunks may go ahead of each other.
template <class Stiffness, class Rolling>
struct SumKickDrift {
  KickAndDrift motion;
  PairForces<Stiffness, Rolling> pairs;
  Walls<Stiffness, Rolling> walls;
  bool has_rolling = false;
  bool last = false;
  Real least_slack = 0;  // of a grain at rest [m]

  KOKKOS_FUNCTION void operator()(int chunk, Real& largest) const {
    if (!pairs.validity.holds()) {  // so that the next one is closed, too
      largest = Kokkos::Experimental::infinity_v<Real>;
      return;
    }
    const int begin = pairs.list.chunks.begin(chunk), end = pairs.list.chunks.end(chunk);
    ContactSum sums[kLargestChunk];
    sum_crossing(pairs.list, motion.grains, begin, end, has_rolling, sums);
    if constexpr (kLargestChunk > 1) {
      if (pairs.list.worn(chunk)) find_active(chunk, begin, end);
      pairs.add_inner(chunk, sums);
    }
    bool worn = false;
    for (int g = begin; g < end; ++g) {
      const Real speed = move(g, sums[g - begin], largest);
      if constexpr (kLargestChunk > 1) {
        Real& slack = pairs.list.slack(g);
        slack -= motion.dt * speed;
        worn = worn || !(slack >= 0);
      }
    }
    pairs.list.worn(chunk) = worn;
  }

  /// The pairs, and the grains beside walls, that can come into contact before a grain has used up
  /// its slack. That is as far as each comes in the same time at the speed that it has, and a
  /// little more.
  KOKKOS_FORCEINLINE_FUNCTION void find_active(int chunk, int begin, int end) const {
    Real way = 0;  // of all grains in a sub-step [m]
    for (int g = begin; g < end; ++g) way += motion.dt * norm(motion.grains(g).u);
    const Real n_steps = steps_of_slack(way / (end - begin));
    for (int g = begin; g < end; ++g) {
      const GrainKinematics& grain = motion.grains(g);
      const Real slack = least_slack + n_steps * motion.dt * norm(grain.u);
      pairs.list.slack(g) = slack;
      pairs.list.near_wall(g) = walls.is_near(g, grain, slack);
    }
    pairs.find_active(chunk);
  }

  /// For how many sub-steps slack is best given. To look for active pairs costs once, more of them
  /// cost in every sub-step, and how many more grows with `way`, the mean one of a grain in a
  /// sub-step [m]. Measured (docs/performance.md); hardly anything changes from 20 to 200.
  KOKKOS_FORCEINLINE_FUNCTION Real steps_of_slack(Real way) const {
    const Real n_steps = Kokkos::sqrt(100 * least_slack / way);
    return n_steps < 100 ? n_steps : 100;
  }

  /// Adds the walls to the sum of a grain's contacts; kick, and unless it is the last sub-step kick
  /// and drift of the next one. Returns the speed of the drift [m/s].
  KOKKOS_FORCEINLINE_FUNCTION Real move(int g, ContactSum& sum, Real& largest) const {
    const GrainKinematics& grain = motion.grains(g);
    if (kLargestChunk == 1 || pairs.list.near_wall(g)) walls.add(g, grain, motion.dt, sum);
    if (last) {
      motion.contact_force(g) = sum.force.vec();
      motion.contact_torque(g) = sum.torque.vec();
    }
    Quad x = grain.x_r(), u = grain.u_m(), omega = grain.spin();
    GrainForces f = motion.forces(g, grain, sum);
    const HalfKick kick(motion.dt / 2, f);
    Quad impulse = kick(f, u, omega);
    if (!last) impulse = impulse + motion.kick_and_drift(g, kick, f, x, u, omega, largest);
    motion.store(g, x, u, omega, impulse);
    return norm(u.vec());
  }
};

}  // namespace barchan
