// Velocity Verlet of rigid clumps of spheres: forces of the spheres summed, the clump moved, the
// spheres put where they belong.
#pragma once

#include "kernels/grains/clump.hpp"
#include "kernels/grains/grain_motion.hpp"
#include "kernels/grains/pair_list.hpp"

namespace barchan {

/// Force on a clump [N] and torque about its centre of mass [N m].
struct ClumpForce {
  Vec3 force, torque;
};

/// What the kernels of clumps read of them.
struct ClumpsOfGrains {
  ClumpShapes shapes;
  ClumpMembers members;
  Kokkos::View<ClumpMotion*> motion;
  Kokkos::View<const std::uint8_t*> kind;  // kinds of the entries; empty: one kind

  KOKKOS_FORCEINLINE_FUNCTION int entry(int clump, int member) const {
    return members.entry(members.first(clump) + member);
  }
  KOKKOS_FORCEINLINE_FUNCTION int head(int clump) const { return entry(clump, 0); }
  KOKKOS_FORCEINLINE_FUNCTION int kind_of(int entry) const {
    return kind.extent(0) > 0 ? kind(entry) : 0;
  }
  /// Vector from the centre of a clump to that of one of its spheres [m].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 arm(const ClumpMotion& c, int of_kind, int member) const {
    return c.d * rotate(c.q, shapes.centre(of_kind, member));
  }
  KOKKOS_FORCEINLINE_FUNCTION PartOfClump part(const ClumpMotion& c, int of_kind,
                                               int member) const {
    return {.q = c.q,
            .shadows = shapes.shadows[of_kind],
            .sphericity = shapes.sphericity[of_kind],
            .d = c.d,
            .radius = c.d * shapes.sphere(shapes.first[of_kind] + member).w(),
            .share = shapes.share(shapes.first[of_kind] + member)};
  }
  /// Principal moments of inertia [kg m^2].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 inertia(const ClumpMotion& c, int of_kind) const {
    return (c.m * c.d * c.d) * shapes.inertia[of_kind];
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 spin(const ClumpMotion& c, int of_kind) const {
    return angular_velocity(c.q, inertia(c, of_kind), c.j);
  }
  /// Sums the forces F and torques T on the spheres, each about its own centre at r from that of
  /// the clump: F and T + r x F.
  KOKKOS_FORCEINLINE_FUNCTION ClumpForce sum(int clump, const ClumpMotion& c, int of_kind,
                                             const Kokkos::View<const Vec3*>& force,
                                             const Kokkos::View<const Vec3*>& torque) const {
    ClumpForce sum{};
    for (int k = 0; k < shapes.count(of_kind); ++k) {
      const int e = entry(clump, k);
      sum.force += force(e);
      sum.torque += torque(e) + cross(arm(c, of_kind, k), force(e));
    }
    return sum;
  }
};

/// Kinetic energy of translation and rotation, (m |U|^2 + J . omega) / 2 [J].
struct ClumpKineticEnergy {
  ClumpsOfGrains clumps;
  KOKKOS_FUNCTION void operator()(int clump, Real& sum) const {
    const int head = clumps.head(clump);
    const ClumpMotion c = clumps.motion(head);
    sum += (c.m * dot(c.u, c.u) + dot(c.j, clumps.spin(c, clumps.kind_of(head)))) / 2;
  }
};

/// Moves the clumps, one an index: half kicks of velocity and angular momentum, drift, free
/// rotation. Spheres get x = X + r, u = U + omega x r and the spin omega of the clump. Reduces the
/// largest excess of a sphere over its skin [m^2].
template <Moves moves>
struct MoveClumps {
  Real dt = 0;
  Real elapsed = 0;  // since the fluid step began [s]
  PeriodicBox box;
  ListValidity validity;  // read but before the first grain step
  ClumpsOfGrains clumps;
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<const Vec3*> contact_force, contact_torque;  // of the spheres
  Kokkos::View<const Vec3*> x_reference;                    // positions at the last list rebuild
  FluidOnGrains fluid;  // on the clumps, under their first spheres
  PairList list;

  KOKKOS_FUNCTION void operator()(int clump, Real& largest) const {
    if (moves != Moves::into_first && !validity.holds()) {  // closes the next grain step, too
      largest = Kokkos::Experimental::infinity_v<Real>;
      return;
    }
    const int head = clumps.head(clump), kind = clumps.kind_of(head);
    ClumpMotion c = clumps.motion(head);
    const ClumpForce contacts = clumps.sum(clump, c, kind, contact_force, contact_torque);
    kick(head, kind, contacts, c);
    if constexpr (moves != Moves::out_of_last) {
      c.x = fma(dt, c.u, c.x);
      c.q = rotate_freely(c.q, clumps.inertia(c, kind), c.j, dt);
    }
    clumps.motion(head) = c;
    move_spheres(clump, c, kind, largest);
  }

 private:
  /// Half a kick, or two: the end of one grain step and the start of the next.
  KOKKOS_FORCEINLINE_FUNCTION void kick(int head, int kind, const ClumpForce& contacts,
                                        ClumpMotion& c) const {
    GrainForces f{};
    f.force = contacts.force + fluid.explicit_force(head);
    MotionCoefficients coefficients{.mass = c.m, .inertia_moment = 1};
    if (fluid.has_fluid) {
      f.u_f = fluid.u_f_after(elapsed, head);
      f.acceleration = fluid.acceleration(head);
      coefficients.inv_fluid_mass = fluid.inv_fluid_mass(head);
      coefficients.beta = fluid.beta(head);
      coefficients.added_mass = fluid.added_mass(head);
    }
    const HalfKick half_kick(dt / 2, coefficients);
    Vec3 no_spin{};
    Vec3 impulse = half_kick(f, c.u, no_spin);
    if constexpr (moves == Moves::between) impulse += half_kick(f, c.u, no_spin);
    const Real h = moves == Moves::between ? dt : dt / 2;
    c.j = fma(h, contacts.torque, c.j);
    if (fluid.has_torque) c.j = turned_by_fluid(head, kind, h, c);
    if (fluid.has_fluid) fluid.impulse(head) += impulse;
  }

  /// Angular momentum after a time h of the torque beta_r (omega_f - omega) on the sphere of the
  /// clump's volume, implicit in the spin: l_k = (l_k + h beta_r omega_fk)/(1 + h beta_r/I_k) along
  /// the principal axes.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 turned_by_fluid(int head, int kind, Real h,
                                                   const ClumpMotion& c) const {
    const Real rate = h * fluid.beta_r(head);
    const Vec3 inertia = clumps.inertia(c, kind);
    const Vec3 l = rotate_back(c.q, c.j + rate * fluid.omega_f(head));
    return rotate(c.q, {l.x / (1 + rate / inertia.x), l.y / (1 + rate / inertia.y),
                        l.z / (1 + rate / inertia.z)});
  }

  KOKKOS_FORCEINLINE_FUNCTION void move_spheres(int clump, const ClumpMotion& c, int kind,
                                                Real& largest) const {
    const Vec3 omega = clumps.spin(c, kind);
    for (int k = 0; k < clumps.shapes.count(kind); ++k) {
      const int e = clumps.entry(clump, k);
      GrainKinematics& sphere = grains(e);
      const Vec3 arm = clumps.arm(c, kind, k);
      sphere.u = c.u + cross(omega, arm);
      sphere.omega = omega;
      if constexpr (moves == Moves::out_of_last) continue;
      const Vec3 before = sphere.x, x = nearest_to(before, c.x + arm);
      sphere.x = x;
      clumps.motion(e).x = c.x;
      largest = Kokkos::max(largest, excess_over_skin(x - x_reference(e), sphere.skin));
      if constexpr (kOnHost && moves == Moves::between) use_slack(e, norm(x - before));
    }
  }

  /// Image of a position that is nearest to another one: spheres were wrapped one by one.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 nearest_to(const Vec3& place, Vec3 x) const {
    if (box.lx > 0) x.x += box.lx * Kokkos::round((place.x - x.x) / box.lx);
    if (box.lz > 0) x.z += box.lz * Kokkos::round((place.z - x.z) / box.lz);
    return x;
  }

  /// As in GrainMotion: a sphere that has used up its slack lets its chunk look for active pairs.
  KOKKOS_FORCEINLINE_FUNCTION void use_slack(int e, Real distance) const {
    list.slack(e) -= distance;
    if (!(list.slack(e) >= 0)) Kokkos::atomic_store(&list.expired(e / list.chunks.size), 1);
  }
};

}  // namespace barchan
