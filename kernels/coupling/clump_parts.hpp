// Clumps in a computed flow. The flow meets each sphere of a clump as a grain of its own that has
// the sphere's share of the volume and of the drag; the clump moves with the sums of all.
#pragma once

#include "kernels/grains/clump_motion.hpp"

namespace barchan {

/// Makes the spheres of a clump parts of it: of the clump's volume and mass each has its share.
struct PartsOfClumps {
  ClumpsOfGrains clumps;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<GrainKinematics*> part_kin;
  Kokkos::View<PartOfClump*> part;

  KOKKOS_FUNCTION void operator()(int clump) const {
    const int head = clumps.head(clump), kind = clumps.kind_of(head);
    const ClumpMotion c = clumps.motion(head);
    for (int k = 0; k < clumps.shapes.count(kind); ++k) {
      const int e = clumps.entry(clump, k);
      part(e) = clumps.part(c, kind, k);
      part_kin(e) = grains(e);
      part_kin(e).r = Kokkos::cbrt(part(e).share) * c.d / 2;
      part_kin(e).m = part(e).share * c.m;
    }
  }
};

/// Joins what the flow does to the spheres of a clump: sums of forces and coefficients; of
/// velocities and accelerations the means by shares s. Its share of fluid has the mean of the
/// fluid per solid, 1/m_f = sum of s^2/m_fs. All of it stands with the first sphere.
struct JoinParts {
  ClumpsOfGrains clumps;
  FluidOnGrains on_grains;

  KOKKOS_FUNCTION void operator()(int clump) const {
    const int head = clumps.head(clump), kind = clumps.kind_of(head);
    const FluidOnGrains& f = on_grains;
    Vec3 force, u_f, acceleration, omega_f;
    Real inv_fluid_mass = 0, beta = 0, added_mass = 0, beta_r = 0;
    for (int k = 0; k < clumps.shapes.count(kind); ++k) {
      const int e = clumps.entry(clump, k);
      const Real share = f.part(e).share;
      force += f.explicit_force(e);
      u_f += share * f.u_f(e);
      acceleration += share * f.acceleration(e);
      inv_fluid_mass += share * share * f.inv_fluid_mass(e);
      beta += f.beta(e);
      added_mass += f.added_mass(e);
      f.explicit_force(e) = f.u_f(e) = f.acceleration(e) = Vec3{};
      f.inv_fluid_mass(e) = f.beta(e) = f.added_mass(e) = 0;
      if (!f.has_torque) continue;
      omega_f += share * f.omega_f(e);
      beta_r += f.beta_r(e);
      f.omega_f(e) = Vec3{};
      f.beta_r(e) = 0;
    }
    f.explicit_force(head) = force;
    f.u_f(head) = u_f;
    f.acceleration(head) = acceleration;
    f.inv_fluid_mass(head) = inv_fluid_mass;
    f.beta(head) = beta;
    f.added_mass(head) = added_mass;
    if (!f.has_torque) return;
    f.omega_f(head) = omega_f;
    f.beta_r(head) = beta_r;
  }
};

/// Gives each sphere of a clump its share of the impulse on the clump, of its drag and of its
/// fluid, for the deposit.
struct SplitOverParts {
  ClumpsOfGrains clumps;
  FluidOnGrains on_grains;

  KOKKOS_FUNCTION void operator()(int clump) const {
    const int head = clumps.head(clump), kind = clumps.kind_of(head);
    const FluidOnGrains& f = on_grains;
    const Vec3 impulse = f.impulse(head);
    const Real beta = f.beta(head), inv_fluid_mass = f.inv_fluid_mass(head);
    for (int k = 0; k < clumps.shapes.count(kind); ++k) {
      const int e = clumps.entry(clump, k);
      const Real share = f.part(e).share;
      f.impulse(e) = share * impulse;
      f.beta(e) = share * beta;
      f.inv_fluid_mass(e) = inv_fluid_mass / share;
    }
  }
};

}  // namespace barchan
