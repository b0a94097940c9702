// Direct forcing at markers: the predicted flow gets the velocity of the solid on the surface of
// each grain. Equations: docs/theory-resolved.md.
#pragma once

#include <cstdint>

#include "kernels/coupling/grain_patch.hpp"
#include "kernels/coupling/markers.hpp"
#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/math/device_scalar.hpp"

namespace barchan {

/// Values of all markers, those of a grain side by side.
struct MarkerValues {
  Kokkos::View<Vec3*> wanted;  // velocity that u* should have there [m/s]
  Kokkos::View<Vec3*> slip;    // what u* lacks of it [m/s]
  Kokkos::View<Vec3*> given;   // sum of what it got over the loops [m/s]
};

/// Sets the velocity wanted of u* at each marker: that of the solid, less what the pressure and the
/// drive of the last step will add,
///   dt (f - grad p / rho).
struct WantedAtMarkers {
  GridRef grid;
  Markers markers;
  ConstFieldRef p;  // of the last step, with ghosts [Pa]
  Vec2 drive;       // of the last step [m/s^2]
  Real dt, inv_density;
  MarkerValues values;

  KOKKOS_FUNCTION void operator()(int q) const {
    const int g = q / markers.n, m = q % markers.n;
    const MarkerFaces faces(grid, markers.place(g, m));
    const Vec3 gradient =
        faces.mean([&](int i, int j, int k) { return ddx_at_xface(grid, p, i, j, k); },
                   [&](int i, int j, int k) { return ddy_at_yface(grid, p, i, j, k); },
                   [&](int i, int j, int k) { return ddz_at_zface(grid, p, i, j, k); });
    const Vec3 push = dt * (Vec3{drive.x, 0, drive.z} - inv_density * gradient);
    values.wanted(q) = markers.velocity(g, m) - push;
    values.given(q) = Vec3{};
  }
};

/// Finds the slip of u* at each marker; reduces its largest component [m/s].
struct SlipAtMarkers {
  GridRef grid;
  Markers markers;
  ConstFaceRef u_star;
  MarkerValues values;

  KOKKOS_FUNCTION void operator()(int q, Real& largest) const {
    const MarkerFaces faces(grid, markers.place(q / markers.n, q % markers.n));
    const Vec3 slip = values.wanted(q) - faces.mean(u_star.x, u_star.y, u_star.z);
    values.slip(q) = slip;
    values.given(q) += slip;
    for (const Real one : {slip.x, slip.y, slip.z})
      largest = Kokkos::max(largest, Kokkos::abs(one));
  }
};

/// Sums on faces in fixed point, so that they do not depend on the order.
struct MarkerSums {
  // More grains than can share a face, each giving it the whole slip.
  static constexpr Real kMostOnFace = 128;
  Kokkos::View<std::int64_t* [3], Kokkos::LayoutLeft> on_faces;  // (face, direction)

  KOKKOS_FORCEINLINE_FUNCTION static FixedPoint point(Real largest_slip) {
    return fixed_point_for(kMostOnFace * largest_slip);
  }
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t face(const GridRef& grid, int i, int j, int k) {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(grid.nx) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(grid.ny) * static_cast<std::size_t>(k));
  }
};

/// Spreads the slip of each marker over the faces around it.
struct SpreadSlip {
  GridRef grid;
  Markers markers;
  Real h;  // width of a cell [m]
  Kokkos::View<const Vec3*> slip;
  DeviceScalar largest_slip;
  MarkerSums sums;

  KOKKOS_FUNCTION void operator()(int q) const {
    const int g = q / markers.n;
    const MarkerFaces faces(grid, markers.place(g, q % markers.n));
    const Real volume = marker_volume((markers.grains(g).r - markers.retraction) / h, markers.n);
    const FixedPoint point = MarkerSums::point(largest_slip);
    const Vec3 share = volume * slip(q);
    const auto give = [&](int direction, Real of_marker) {
      return [this, &point, direction, of_marker](int i, int j, int k, Real w) {
        Kokkos::atomic_add(&sums.on_faces(MarkerSums::face(grid, i, j, k), direction),
                           point.encode(w * of_marker));
      };
    };
    faces.each_x(give(0, share.x)), faces.each_y(give(1, share.y)), faces.each_z(give(2, share.z));
  }
};

/// Adds the sums to u*, and clears them. Patches overlap: a sum goes to the first that takes it.
struct AddToFlow {
  GrainPatch patch;
  Kokkos::View<const GrainKinematics*> grains;
  DeviceScalar largest_slip;
  MarkerSums sums;
  FaceRef u_star;

  KOKKOS_FUNCTION void operator()(int item) const {
    const int g = item / patch.rows();
    const FixedPoint point = MarkerSums::point(largest_slip);
    patch.each_cell(grains(g).x, item % patch.rows(), [&](int i, int j, int k) {
      const std::size_t face = MarkerSums::face(patch.grid, i, j, k);
      add(face, 0, point, u_star.x(i, j, k));
      add(face, 1, point, u_star.y(i, j, k));
      add(face, 2, point, u_star.z(i, j, k));
    });
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(std::size_t face, int direction, const FixedPoint& point,
                                       Real& u) const {
    std::int64_t* const sum = &sums.on_faces(face, direction);
    if (Kokkos::atomic_load(sum) == 0) return;
    const std::int64_t taken = Kokkos::atomic_exchange(sum, std::int64_t{0});
    if (taken != 0) u += point.decode(taken);
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
