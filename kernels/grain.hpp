// A grain as its neighbours see it, the box it moves in, and the pairs it may touch.
#pragma once

#include <cstdint>

#include "kernels/vec3.hpp"

namespace barchan {

/// What a contact needs of one grain, side by side in memory: two cache lines per neighbour
/// instead of eleven.
struct alignas(32) GrainKinematics {
  Vec3 x;      // centre [m]
  Real r = 0;  // radius [m]
  Vec3 u;      // velocity [m/s]
  Real m = 0;  // mass [kg]
  Vec3 omega;  // spin [rad/s]
  Real padding = 0;
};

/// Periodic extents: zero where a direction is not periodic.
struct PeriodicBox {
  Real lx = 0, lz = 0;  // [m]

  /// Nearest image of a separation between two grains of the box.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 nearest_image(Vec3 s) const {
    s.x -= s.x > lx / 2 ? lx : Real(0);
    s.x += s.x < -lx / 2 ? lx : Real(0);
    s.z -= s.z > lz / 2 ? lz : Real(0);
    s.z += s.z < -lz / 2 ? lz : Real(0);
    return s;
  }
};

/// What one pair did in the last sub-step: one cache line, all zero while it does not touch.
struct alignas(64) PairLine {
  Vec3 force;       // on the first grain [N]
  Real delta_n = 0; // [m]
  Vec3 twist;       // n x F_t [N]
  Real padding = 0;
};

/// Half Verlet list with the contacts' history. Pairs of grain i are the slots
/// [first(i), first(i+1)), with i the first grain; grain i is the second one in the slots
/// other_slot[other_first(i) .. other_first(i+1)).
struct PairList {
  int n_pairs = 0;
  Kokkos::View<int*> first, other_first;  // (n + 1)
  Kokkos::View<int*> i, j, other_slot;    // (n_pairs)
  Kokkos::View<PairLine*> line;           // (n_pairs)
  Kokkos::View<Vec3*> xi_t;               // tangential displacement of i relative to j [m]
  Kokkos::View<Vec3*> rolling;            // rolling torque on i [N m]; empty without a rolling spring
  Kokkos::View<std::uint8_t*> touching;   // 1 while in contact
};

}  // namespace barchan
