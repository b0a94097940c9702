// Direct forcing at markers: the predicted flow gets the velocity of the solid on the surface of
// each grain. Equations: docs/theory-resolved.md.
#pragma once

#include <cstdint>

#include "kernels/coupling/markers.hpp"
#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/math/on_host.hpp"

namespace barchan {

/// Velocity of the flow after the step, if pressure and drive are those of the last one:
///   u* + dt (f - grad p / rho).
struct VelocityAhead {
  GridRef grid;
  ConstFaceRef u_star;
  ConstFieldRef p;  // of the last step, with ghosts [Pa]
  Vec2 drive;       // of the last step [m/s^2]
  Real dt, inv_density;

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    return u_star.x(i, j, k) + dt * (drive.x - inv_density * ddx_at_xface(grid, p, i, j, k));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    return u_star.y(i, j, k) - dt * inv_density * ddy_at_yface(grid, p, i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    return u_star.z(i, j, k) + dt * (drive.z - inv_density * ddz_at_zface(grid, p, i, j, k));
  }
};

/// What the grains work with, those of a grain side by side.
struct MarkerValues {
  Kokkos::View<Real*> patch;  // of the faces around each grain [m/s]
  Kokkos::View<Vec3*> read;   // velocity of the flow at each marker [m/s]
  Kokkos::View<Vec3*> given;  // sum of what each gave over the loops [m/s]
};

/// Reads the flow at the markers of each grain, a team per grain. On a grid that is cut it reads
/// the part on this rank.
struct ReadAtMarkers {
  using Team = Kokkos::TeamPolicy<>::member_type;
  GrainPatch patch;
  Markers markers;
  VelocityAhead flow;
  MarkerValues values;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int g = team.league_rank();
    const PatchCorner corner = patch.corner(markers.grains(g).x);
    Real* const here = values.patch.data() + static_cast<std::ptrdiff_t>(g) * patch.size();
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, patch.rows()),
                         [&](int row) { copy(corner, row, here); });
    team.team_barrier();
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, markers.n), [&](int m) {
      const MarkerLines lines(patch, corner, markers.place(g, m));
      values.read(g * markers.n + m) = lines.mean(patch, here);
    });
  }

 private:
  /// Copies a row of the flow; it is zero where this rank has no faces.
  KOKKOS_FORCEINLINE_FUNCTION void copy(const PatchCorner& corner, int row, Real* to) const {
    for (int a = 0; a < patch.n[0]; ++a) to[patch.n[0] * row + a] = 0;
    const int direction = row / (patch.n[1] * patch.n[2]);
    patch.each_run(corner, row, [&](int at, int i, int j, int k, int n) {
      Real* const first = to + at;
      if (direction == 0) {
#pragma omp simd
        for (int q = 0; q < n; ++q) first[q] = flow.x(i + q, j, k);
      } else if (direction == 1) {
#pragma omp simd
        for (int q = 0; q < n; ++q) first[q] = flow.y(i + q, j, k);
      } else {
#pragma omp simd
        for (int q = 0; q < n; ++q) first[q] = flow.z(i + q, j, k);
      }
    });
  }
};

/// Spreads what the flow lacks at the markers of each grain over the faces of its patch, a team per
/// grain. On the host a team is one thread: it adds in the order of the markers. On a device they
/// add at once, in fixed point, so that sums do not depend on the order.
struct SpreadSlip {
  using Team = Kokkos::TeamPolicy<>::member_type;
  GrainPatch patch;
  Markers markers;
  Real h;  // width of a cell [m]
  MarkerValues values;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int g = team.league_rank(), size = patch.size();
    const PatchCorner corner = patch.corner(markers.grains(g).x);
    const Real volume = marker_volume((markers.grains(g).r - markers.retraction) / h, markers.n);
    Real* const sums = values.patch.data() + static_cast<std::ptrdiff_t>(g) * size;
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, size), [&](int at) { sums[at] = 0; });
    const FixedPoint point = kOnHost ? FixedPoint{} : point_of(team, g);
    team.team_barrier();
    Kokkos::parallel_for(Kokkos::TeamThreadRange(team, markers.n), [&](int m) {
      const int q = g * markers.n + m;
      const Vec3 slip = markers.velocity(g, m) - values.read(q);
      values.given(q) += slip;
      const MarkerLines lines(patch, corner, markers.place(g, m));
      const Real share[3] = {volume * slip.x, volume * slip.y, volume * slip.z};
      for (int direction = 0; direction < 3; ++direction) {
        lines.each_line(patch, direction, [&](int at, Real w, const DeltaLine& x) {
          add(sums + at, share[direction] * w, x, point);
        });
      }
    });
    if constexpr (!kOnHost) {
      team.team_barrier();
      Kokkos::parallel_for(Kokkos::TeamThreadRange(team, size),
                           [&](int at) { sums[at] = point.decode(*as_integer(sums + at)); });
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static std::int64_t* as_integer(Real* number) {
    return reinterpret_cast<std::int64_t*>(number);
  }
  KOKKOS_FORCEINLINE_FUNCTION static void add(Real* to, Real w, const DeltaLine& x,
                                              const FixedPoint& point) {
    if constexpr (kOnHost) {
      fma(w, Vec4(x.weight[0], x.weight[1], x.weight[2], 0), Vec4(to)).store(to);
    } else {
      for (int a = 0; a < 3; ++a)
        Kokkos::atomic_add(as_integer(to + a), point.encode(w * x.weight[a]));
    }
  }
  /// Fixed point in which no face can overflow: one that gets the slip of every marker.
  KOKKOS_FUNCTION FixedPoint point_of(const Team& team, int g) const {
    Real largest = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, markers.n),
        [&](int m, Real& most) {
          const Vec3 slip = markers.velocity(g, m) - values.read(g * markers.n + m);
          for (const Real one : {slip.x, slip.y, slip.z})
            most = Kokkos::max(most, Kokkos::abs(one));
        },
        Kokkos::Max<Real>(largest));
    return fixed_point_for(2 * markers.n * largest);
  }
};

/// Adds the patches of all grains to u*, a team per plane of cells. Grains come one after the
/// other, so that sums do not depend on threads.
struct AddToFlow {
  using Team = Kokkos::TeamPolicy<>::member_type;
  GrainPatch patch;
  Kokkos::View<const GrainKinematics*> grains;
  int n_grains;
  Kokkos::View<const Real*> patches;
  FaceRef u_star;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int k = team.league_rank();
    for (int g = 0; g < n_grains; ++g) {
      const PatchCorner corner = patch.corner(grains(g).x);
      const Real* const sums = patches.data() + static_cast<std::ptrdiff_t>(g) * patch.size();
      const int across = patch.plane(corner, 0, k), along = patch.plane(corner, 2, k);
      // In a narrow box a grain may have several planes of its patch here.
      for (int turn = 0; Kokkos::min(across, along) + turn < patch.n[2];
           turn += patch.grid.nz_all) {
        Kokkos::parallel_for(Kokkos::TeamThreadRange(team, 3 * patch.n[1]), [&](int row) {
          const int direction = row / patch.n[1], c = turn + (direction == 2 ? along : across);
          if (c < patch.n[2]) add(corner, direction, row % patch.n[1], c, sums);
        });
        team.team_barrier();
      }
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(const PatchCorner& corner, int direction, int b, int c,
                                       const Real* sums) const {
    const FieldRef& u = direction == 0 ? u_star.x : direction == 1 ? u_star.y : u_star.z;
    patch.each_run(corner, direction, b, c, [&](int at, int i, int j, int k, int n) {
      Real* const to = &u(i, j, k);
#pragma omp simd
      for (int q = 0; q < n; ++q) to[q] += sums[at + q];
    });
  }
};

/// Impulse [N s] and its moment about the centre [N m s] that the markers of a grain give to the
/// water.
struct ImpulseOnWater {
  Vec3 linear, angular;
  KOKKOS_FORCEINLINE_FUNCTION ImpulseOnWater& operator+=(const ImpulseOnWater& more) {
    linear += more.linear;
    angular += more.angular;
    return *this;
  }
};

/// Sets the impulse that the markers of each grain gave to the water, a team per grain.
struct SumOfMarkers {
  using Team = Kokkos::TeamPolicy<>::member_type;
  Markers markers;
  Real h, cell_volume, density;
  Kokkos::View<const Vec3*> given;
  Kokkos::View<ImpulseOnWater*> impulse;

  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int g = team.league_rank();
    ImpulseOnWater sum;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, markers.n),
        [&](int m, ImpulseOnWater& all) {
          const Vec3 one = given(g * markers.n + m);
          all += {one, cross(markers.arm(g, m), one)};
        },
        Kokkos::Sum<ImpulseOnWater>(sum));
    const Real mass = density * cell_volume *
                      marker_volume((markers.grains(g).r - markers.retraction) / h, markers.n);
    Kokkos::single(Kokkos::PerTeam(team), [&] {
      impulse(g) = {mass * sum.linear, mass * sum.angular};
    });
  }
};

/// Adds up what the flow rate along x loses to the markers [m^2/s], as FlowNumber::kTaken.
struct RateTaken {
  Kokkos::View<const ImpulseOnWater*> impulse;
  Real per_impulse;  // row height / (density cell volume)
  KOKKOS_FUNCTION void operator()(int g, Vec3& taken) const {
    taken.x -= per_impulse * impulse(g).linear.x;
  }
};

}  // namespace barchan

template <>
struct Kokkos::reduction_identity<barchan::ImpulseOnWater> {
  KOKKOS_FORCEINLINE_FUNCTION static barchan::ImpulseOnWater sum() { return {}; }
};
