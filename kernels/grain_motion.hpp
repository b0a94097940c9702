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
    sum.force = sum.force + quad(line.force);
    sum.torque = sum.torque + (line.delta_n / 2 - radius) * quad(line.twist);
    if (has_rolling) sum.torque = sum.torque + quad(list.rolling(p));
  }
  for (int s = list.other_first(g); s < list.other_first(g + 1); ++s) {
    const PairLine& line = list.line(list.other_slot(s));
    sum.force = sum.force - quad(line.force);
    sum.torque = sum.torque + (line.delta_n / 2 - radius) * quad(line.twist);
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
                                                 const Vec3& contacts, const Vec3& torque) const {
    GrainForces f;
    f.force = contacts + fluid.steady_force(g);
    f.torque = torque;
    f.inertia_mass = grain.m;
    f.inertia_moment = sphere_inertia(grain.m, grain.r);
    if (fluid.none) return f;
    f.u_f = fluid.u_f(g);
    f.beta = fluid.beta(g);
    f.inertia_mass += fluid.added_mass(g);
    return f;
  }

  KOKKOS_FORCEINLINE_FUNCTION void kick_and_drift(int g, GrainKinematics& grain,
                                                  const HalfKick& kick, const GrainForces& f,
                                                  Vec3& impulse, Real& largest) const {
    impulse += kick(f, grain.u, grain.omega);
    grain.x += dt * grain.u;
    const Vec3 moved = grain.x - x_reference(g);
    const Real distance2 = dot(moved, moved);
    // The negation lets a NaN through, so that the next rebuild meets and reports it.
    if (!(distance2 <= largest)) largest = distance2;
  }

  /// Reduces the largest squared distance from the reference positions [m^2].
  KOKKOS_FUNCTION void operator()(int g, Real& largest) const {
    GrainKinematics grain = grains(g);
    Vec3 impulse;
    const GrainForces f = forces(g, grain, contact_force(g), contact_torque(g));
    kick_and_drift(g, grain, HalfKick(dt / 2, f), f, impulse, largest);
    if (!fluid.none) fluid.drag_impulse(g) += impulse;
    grains(g) = grain;
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
      pairs.add_inner(chunk, sums, last);
    }
    Real fastest = 0;  // squared speed [m^2/s^2]
    for (int g = begin; g < end; ++g) {
      const Vec3 u = move(g, sums[g - begin], largest);
      fastest = dot(u, u) > fastest ? dot(u, u) : fastest;
    }
    if constexpr (kLargestChunk > 1)
      pairs.list.slack(chunk) -= 2 * motion.dt * Kokkos::sqrt(fastest);
  }

  /// Returns the velocity of the drift [m/s].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 move(int g, const ContactSum& sum, Real& largest) const {
    GrainKinematics grain = motion.grains(g);
    Vec3 force = sum.force.vec(), torque = sum.torque.vec();
    walls.add(g, grain, motion.dt, force, torque);
    if (last) motion.contact_force(g) = force, motion.contact_torque(g) = torque;
    const GrainForces f = motion.forces(g, grain, force, torque);
    const HalfKick kick(motion.dt / 2, f);
    Vec3 impulse = kick(f, grain.u, grain.omega);
    if (!last) motion.kick_and_drift(g, grain, kick, f, impulse, largest);
    if (!motion.fluid.none) motion.fluid.drag_impulse(g) += impulse;
    motion.grains(g) = grain;
    return grain.u;
  }
};

}  // namespace barchan
