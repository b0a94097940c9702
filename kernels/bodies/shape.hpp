// Contract of the shapes of bodies. Lengths in m; the origin is the middle of the underside, y
// upwards.
// A shape is a type in a file of its own, in the list `BodyShapes` (body.hpp):
//   named                its word in a case, and what it is
//   keys(body)           which keys of [[body]] it needs above 0, and which it takes as well
//   from(body)           the shape of a [[body]]
//   footprint(body)      the box around it
//   fault(body)          what is wrong with the keys together; not every shape has it
//   misfit(body, lx)     why it does not fit into periods of the domain; not every shape has it
//   to_surface(p)        distance and normal
//   curvature()          radius where a grain touches it, 0: as a flat wall
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "kernels/math/alternatives.hpp"
#include "kernels/math/vec3.hpp"

namespace barchan {

enum class Axis { x, y, z };

/// Distance and direction from a position to a surface.
struct ToSurface {
  Real distance = 0;  // [m], positive outside
  Vec3 normal;        // unit vector outwards: the gradient of the distance
};

/// Distance to a convex body near a corner where faces meet at right angles. d [m] are the
/// distances to the faces, n their normals.
template <int faces>
KOKKOS_INLINE_FUNCTION ToSurface to_corner(const Real (&d)[faces], const Vec3 (&n)[faces]) {
  int nearest = 0, outside = 0;
  Vec3 out;
  for (int f = 0; f < faces; ++f) {
    if (d[f] > d[nearest]) nearest = f;
    if (d[f] <= 0) continue;
    ++outside;
    out += d[f] * n[f];
  }
  if (outside < 2) return {d[nearest], n[nearest]};
  const Real distance = norm(out);
  return {distance, (1 / distance) * out};
}

KOKKOS_FORCEINLINE_FUNCTION Real sign_of(Real a) { return a < 0 ? Real(-1) : Real(1); }

/// Unit vector along (x, 0, z), which has length r; along x if that is zero.
KOKKOS_FORCEINLINE_FUNCTION Vec3 away_from_axis(Real x, Real z, Real r) {
  return r > 0 ? Vec3{x / r, 0, z / r} : Vec3{1, 0, 0};
}

/// Distance to a surface y = f(x, z) of slopes f_x and f_z: exact on a plane, to first order in the
/// curvature elsewhere.
KOKKOS_FORCEINLINE_FUNCTION ToSurface to_hill(Real y, Real f, Real f_x, Real f_z) {
  const Real scale = 1 / Kokkos::sqrt(1 + f_x * f_x + f_z * f_z);
  return {scale * (y - f), {-scale * f_x, scale, -scale * f_z}};
}

/// Names of the keys of [[body]] that a shape needs or takes beside name, shape, centre and base.
struct ShapeKeys {
  std::array<std::string_view, 4> needs{}, takes{};
};

/// The box around a shape, with sides along the axes of the domain [m].
struct Footprint {
  Real half_x = 0, half_z = 0;  // 0: through the whole domain
  Real height = 0;
  Real narrowest = 0;  // along the floor: a diameter, a side, a wavelength; infinite: none
  Real middle_x = 0;   // distance from its `centre`
};

/// Fault of a body: its keys, the one to change first, and a message about a number.
struct ShapeFault {
  std::array<std::string_view, 3> keys{};
  const char* message = nullptr;  // nullptr: all is well
  Real number = 0;
};

/// Smaller of two sides of which 0 means none.
inline Real narrower(Real a, Real b) {
  const auto side = [](Real s) { return s > 0 ? s : std::numeric_limits<Real>::infinity(); };
  return std::min(side(a), side(b));
}

}  // namespace barchan
