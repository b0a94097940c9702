// Sums over the grains for reports.
#pragma once

#include "kernels/grains/clump.hpp"
#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/grains/sphere.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {

/// Number of touching pairs, and the largest relative overlap [-]. Pairs whose first grain is a
/// ghost count on the rank that owns it.
struct ContactsOfPairs {
  PeriodicBox box;
  PairList list;
  Kokkos::View<const GrainKinematics*> grains;
  int n_owned;

  KOKKOS_FUNCTION void operator()(int p, std::int64_t& count, Real& overlap) const {
    if (!list.touching(p) || list.i(p) >= n_owned) return;
    ++count;
    const Real relative = relative_overlap(box, grains(list.i(p)), grains(list.j(p)));
    overlap = relative > overlap ? relative : overlap;
  }
};

/// Kinetic energy of translation and rotation, (m |u|^2 + I |omega|^2) / 2 [J].
struct GrainKineticEnergy {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION void operator()(int g, Real& sum) const {
    const GrainKinematics& k = grains(g);
    sum += (k.m * dot(k.u, k.u) + sphere_inertia(k.m, k.r) * dot(k.omega, k.omega)) / 2;
  }
};

/// Volume flow of the grains: sum of V_p u along x or z [m^4/s].
struct GrainVolumeFlow {
  Kokkos::View<const GrainKinematics*> grains;
  bool along_x;
  KOKKOS_FUNCTION void operator()(int g, Real& sum) const {
    const Vec3& u = grains(g).u;
    sum += sphere_volume(grains(g).r) * (along_x ? u.x : u.z);
  }
};

/// Counts the grains that leave: those beyond 0 .. lx along the flow, or whose x is not a number.
/// In a window that follows its dune they are those within a strip around the edge, where its ends
/// meet.
struct CountLeaving {
  PlaceOfGrain place;
  Real lx;               // [m]
  Real half_strip = 0;   // half the width of the strip [m]; 0: there is none
  Real window_edge = 0;  // its middle [m]; not a number: no edge yet
  KOKKOS_FORCEINLINE_FUNCTION bool leaves(int g) const {
    const Real x = place(g).x;
    if (half_strip == 0) return !(x >= 0 && x <= lx);
    const Real from_window_edge = x - window_edge;
    return Kokkos::abs(from_window_edge - lx * Kokkos::round(from_window_edge / lx)) <= half_strip;
  }
  KOKKOS_FUNCTION void operator()(int g, int& count) const { count += leaves(g) ? 1 : 0; }
};

}  // namespace barchan
