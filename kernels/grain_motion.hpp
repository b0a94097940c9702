// One pass over the grains per sub-step: sum the contacts, kick, and drift into the next sub-step.
#pragma once

#include "kernels/grain.hpp"
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
};

/// Sum of the contact forces on grain g from the pair lines, own slots first, then the others.
struct ContactSum {
  Vec3 force, torque;
};

KOKKOS_FORCEINLINE_FUNCTION ContactSum sum_contacts(const PairList& list, int g, Real radius,
                                                    bool has_rolling) {
  ContactSum sum;
  for (int p = list.first(g); p < list.first(g + 1); ++p) {
    const PairLine& line = list.line(p);
    sum.force += line.force;
    sum.torque += (line.delta_n / 2 - radius) * line.twist;
    if (has_rolling) sum.torque += list.rolling(p);
  }
  for (int s = list.other_first(g); s < list.other_first(g + 1); ++s) {
    const PairLine& line = list.line(list.other_slot(s));
    sum.force += -line.force;
    sum.torque += (line.delta_n / 2 - radius) * line.twist;
    if (has_rolling) sum.torque += -list.rolling(list.other_slot(s));
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

  KOKKOS_FORCEINLINE_FUNCTION GrainForces forces(int g, const GrainKinematics& grain) const {
    return {.force = contact_force(g) + fluid.steady_force(g),
            .torque = contact_torque(g),
            .u_f = fluid.u_f(g),
            .beta = fluid.beta(g),
            .inertia_mass = grain.m + fluid.added_mass(g),
            .inertia_moment = sphere_inertia(grain.m, grain.r)};
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
    Vec3 impulse = fluid.drag_impulse(g);
    const GrainForces f = forces(g, grain);
    kick_and_drift(g, grain, HalfKick(dt / 2, f), f, impulse, largest);
    fluid.drag_impulse(g) = impulse;
    grains(g) = grain;
  }
};

/// The end of a sub-step: new contact forces, second half kick, and unless it is the last sub-step
/// the first half kick and drift of the next one.
template <class Stiffness, class Rolling>
struct SumKickDrift {
  KickAndDrift motion;
  PairList list;
  Walls<Stiffness, Rolling> walls;
  bool has_rolling = false;
  bool last = false;

  KOKKOS_FUNCTION void operator()(int g, Real& largest) const {
    GrainKinematics grain = motion.grains(g);
    ContactSum sum = sum_contacts(list, g, grain.r, has_rolling);
    walls.add(g, grain, motion.dt, sum.force, sum.torque);
    motion.contact_force(g) = sum.force;
    motion.contact_torque(g) = sum.torque;
    const GrainForces f = motion.forces(g, grain);
    const HalfKick kick(motion.dt / 2, f);
    Vec3 impulse = motion.fluid.drag_impulse(g) + kick(f, grain.u, grain.omega);
    if (!last) motion.kick_and_drift(g, grain, kick, f, impulse, largest);
    motion.fluid.drag_impulse(g) = impulse;
    motion.grains(g) = grain;
  }
};

}  // namespace barchan
