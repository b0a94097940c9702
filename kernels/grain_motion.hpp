// One pass over the chunks of grains per sub-step: forces of their inner pairs, sum of all
// contacts, kick, and drift into the next sub-step.
#pragma once

#include "kernels/grain.hpp"
#include "kernels/pair_forces.hpp"
#include "kernels/sphere.hpp"
#include "kernels/velocity_verlet.hpp"
#include "kernels/wall_contact.hpp"

namespace barchan {

/// What acts on the grains besides contacts, constant over the sub-steps of a fluid step.
struct FluidOnGrains {
  Kokkos::View<Vec3*> u_f;           // [m/s]
  Kokkos::View<Real*> beta;          // [kg/s]
  Kokkos::View<Vec3*> steady_force;  // weight, buoyancy, pressure gradient, ... [N]
  Kokkos::View<Real*> added_mass;    // [kg]
  Kokkos::View<Vec3*> drag_impulse;  // sum over the sub-steps of the drag on the grain [N s]
  bool none = false;                 // no fluid: all but steady_force is zero and not read
};

/// Sum of the crossing contacts of grain g from the pair lines, own slots first, then the others.
KOKKOS_FORCEINLINE_FUNCTION ContactSum sum_crossing(const PairList& list, int g, Real radius,
                                                    bool has_rolling) {
  ContactSum sum{};
  for (int p = list.first(g); p < list.first(g + 1); ++p) {
    const PairLine& line = list.line(p);
    sum.force = sum.force + line.force_overlap();
    sum.torque = fused(line.delta_n / 2 - radius, line.twist_quad(), sum.torque);
    if (has_rolling) sum.torque = sum.torque + quad(list.rolling(p));
  }
  for (int s = list.other_first(g); s < list.other_first(g + 1); ++s) {
    const PairLine& line = list.line(list.other_slot(s));
    sum.force = sum.force - line.force_overlap();
    sum.torque = fused(line.delta_n / 2 - radius, line.twist_quad(), sum.torque);
    if (has_rolling) sum.torque = sum.torque - quad(list.rolling(list.other_slot(s)));
  }
  return sum;
}

/// The start of the sub-steps: first half kick with the stored contact forces, then drift.
struct KickAndDrift {
  Real dt = 0;
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<Vec3*> contact_force, contact_torque;
  Kokkos::View<const Vec3*> x_reference;  // positions at the last list rebuild
  FluidOnGrains fluid;

  KOKKOS_FORCEINLINE_FUNCTION GrainForces forces(int g, const GrainKinematics& grain,
                                                 const ContactSum& contacts) const {
    GrainForces f{.force = contacts.force + quad(fluid.steady_force(g)),
                  .torque = contacts.torque,
                  .inertia_mass = grain.m,
                  .inertia_moment = sphere_inertia(grain.m, grain.r)};
    if (fluid.none) return f;
    f.u_f = quad(fluid.u_f(g));
    f.beta = fluid.beta(g);
    f.inertia_mass += fluid.added_mass(g);
    return f;
  }

  /// Half kick from here, then drift; returns the drag impulse. `largest` as below.
  KOKKOS_FORCEINLINE_FUNCTION Quad kick_and_drift(int g, const HalfKick& kick, const GrainForces& f,
                                                  Quad& x, Quad& u, Quad& omega,
                                                  Real& largest) const {
    const Quad impulse = kick(f, u, omega);
    x = fused(dt, u, x);
    const Vec3 moved = x.vec() - x_reference(g);
    const Real distance2 = dot(moved, moved);
    // The negation lets a NaN through, so that the next rebuild meets and reports it.
    if (!(distance2 <= largest)) largest = distance2;
    return impulse;
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(int g, const Quad& x, const Quad& u, const Quad& omega,
                                         const Quad& impulse) const {
    GrainKinematics& grain = grains(g);
    grain.x = x.vec(), grain.u = u.vec(), grain.omega = omega.vec();
    if (!fluid.none) fluid.drag_impulse(g) += impulse.vec();
  }

  /// Reduces the largest squared distance from the reference positions [m^2].
  KOKKOS_FUNCTION void operator()(int g, Real& largest) const {
    const GrainKinematics& grain = grains(g);
    Quad x = grain.x_r(), u = grain.u_m(), omega = grain.spin();
    const GrainForces f =
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
  Real margin = 0;  // within which pairs are active [m]

  KOKKOS_FUNCTION void operator()(int chunk, Real& largest) const {
    const int begin = pairs.list.chunks.begin(chunk), end = pairs.list.chunks.end(chunk);
    ContactSum sums[kLargestChunk];
    for (int g = begin; g < end; ++g) {
      sums[g - begin] = sum_crossing(pairs.list, g, motion.grains(g).r, has_rolling);
    }
    if constexpr (kLargestChunk > 1) {
      Real& slack = pairs.list.slack(chunk);
      if (!(slack >= 0)) {
        pairs.find_active(chunk, margin);
        slack = margin;
      }
      pairs.add_inner(chunk, sums);
    }
    Real fastest = 0;  // squared speed [m^2/s^2]
    for (int g = begin; g < end; ++g) {
      const Real speed2 = move(g, sums[g - begin], largest);
      fastest = speed2 > fastest ? speed2 : fastest;
    }
    if constexpr (kLargestChunk > 1)
      pairs.list.slack(chunk) -= 2 * motion.dt * Kokkos::sqrt(fastest);
  }

  /// Returns the squared speed of the drift [m^2/s^2].
  KOKKOS_FORCEINLINE_FUNCTION Real move(int g, ContactSum sum, Real& largest) const {
    const GrainKinematics& grain = motion.grains(g);
    walls.add(g, grain, motion.dt, sum);
    if (last) {
      motion.contact_force(g) = sum.force.vec();
      motion.contact_torque(g) = sum.torque.vec();
    }
    Quad x = grain.x_r(), u = grain.u_m(), omega = grain.spin();
    const GrainForces f = motion.forces(g, grain, sum);
    const HalfKick kick(motion.dt / 2, f);
    Quad impulse = kick(f, u, omega);
    if (!last) impulse = impulse + motion.kick_and_drift(g, kick, f, x, u, omega, largest);
    motion.store(g, x, u, omega, impulse);
    return dot(u.vec(), u.vec());
  }
};

}  // namespace barchan
