// Shapes of the walls: flat ones, and a floor of glued spheres.
#pragma once

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Wall with unit normal into the domain.
struct Plane {
  Vec3 normal;
  Real offset = 0;

  /// Signed distance of a position, positive inside the domain [m].
  KOKKOS_FORCEINLINE_FUNCTION Real distance(const Vec3& x) const { return dot(normal, x) - offset; }
  /// Overlap with a grain [m]; negative while they do not touch.
  KOKKOS_FORCEINLINE_FUNCTION Real overlap(const GrainKinematics& grain) const {
    return grain.r - distance(grain.x);
  }
};

/// Floor of equal spheres glued in one close-packed layer, their tops in the plane y = 0. They
/// stand in rows along x, at x = (i + j/2) a and z = j b, b = a sqrt(3)/2. Their colour is (i - j)
/// mod 3, so the three corners of every triangle differ, and a grain that no other sphere holds up
/// touches at most one sphere of a colour. Rows and columns are stretched to fit into the periodic
/// domain.
struct GluedFloor {
  static constexpr int kColours = 3;
  Real r = 0;         // radius of a sphere [m]; 0: a flat floor
  Real a = 1, b = 1;  // distance between spheres of a row, and between rows [m]

  /// Number of walls that the floor stands for.
  KOKKOS_FORCEINLINE_FUNCTION int walls() const { return r > 0 ? kColours : 0; }

  /// Centre of the nearest sphere of a colour. Spheres of a colour stand at the corners and in the
  /// middle of rectangles of 3 a times 2 b.
  KOKKOS_INLINE_FUNCTION Vec3 nearest(int colour, const Vec3& x) const {
    const Real along = x.x / a - colour, across = x.z / b;
    const Real corner_x = 3 * Kokkos::round(along / 3), corner_z = 2 * Kokkos::round(across / 2);
    const Real middle_x = 3 * Kokkos::floor(along / 3) + Real(1.5);
    const Real middle_z = 2 * Kokkos::floor(across / 2) + 1;
    const auto squared = [&](Real at_x, Real at_z) {
      const Real dx = a * (along - at_x), dz = b * (across - at_z);
      return dx * dx + dz * dz;
    };
    const bool corner = squared(corner_x, corner_z) <= squared(middle_x, middle_z);
    return {a * ((corner ? corner_x : middle_x) + colour), -r, b * (corner ? corner_z : middle_z)};
  }

  /// Plane that touches the nearest sphere of a colour below x. For an x that has sunk below the
  /// centres it is the plane over all tops, which shows how deep it is.
  KOKKOS_INLINE_FUNCTION Plane under(int colour, const Vec3& x) const {
    const Vec3 centre = nearest(colour, x), up = x - centre;
    if (up.y <= 0) return {.normal = {0, 1, 0}, .offset = 0};
    const Vec3 normal = (1 / norm(up)) * up;
    return {.normal = normal, .offset = dot(normal, centre) + r};
  }
};

/// Layer of spheres of radius r that fits into a domain of lx times lz without a gap.
inline GluedFloor glued_floor(Real r, Real lx, Real lz) {
  const Real a = 2 * r, b = a * Kokkos::sqrt(Real(3)) / 2;
  return {.r = r,
          .a = lx / (3 * Kokkos::floor(lx / (3 * a) * (1 + Real(1e-12)))),
          .b = lz / (2 * Kokkos::floor(lz / (2 * b) * (1 + Real(1e-12))))};
}

/// Largest number of walls: the floor, the top, and two walls each in x and z. Each has a bit in
/// GrainState::wall_touching, which restart files hold, too.
inline constexpr int kMaxWalls = GluedFloor::kColours + 5;
static_assert(kMaxWalls <= 8);

/// Walls of the domain. Each has a contact history of its own, except that two opposite walls
/// farther apart than a grain is wide share one. A floor of glued spheres is the first three walls,
/// one for each colour.
struct WallShapes {
  int n = 0, n_histories = 0;
  Plane plane[kMaxWalls];
  int history[kMaxWalls]{};
  GluedFloor glued;

  /// Wall w as a grain at x meets it.
  KOKKOS_FORCEINLINE_FUNCTION Plane at(int w, const Vec3& x) const {
    return w < glued.walls() ? glued.under(w, x) : plane[w];
  }
  /// Radius of curvature of a contact with a grain of radius r: r r_s/(r + r_s); on a flat wall r.
  KOKKOS_FORCEINLINE_FUNCTION Real effective_radius(int w, Real r) const {
    return w < glued.walls() ? r * glued.r / (r + glued.r) : r;
  }
};

}  // namespace barchan
