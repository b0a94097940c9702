// Errors of a computed flow against a known one, and meshes that refine into each other.
#pragma once

#include <algorithm>
#include <cmath>

#include "src/fluid/fluid_state.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan::test {

/// First row of n rows over `height` of which the last would be `span` times the first in the limit
/// of many: q^n = span for every n, so that twice the rows halve every row of the coarser mesh.
inline double first_row(double height, int n, double span) {
  if (span == 1) return 0;
  return height * std::expm1(std::log(span) / n) / (span - 1);
}

/// RMS over the volume and the largest, of the velocity (all components) and of the pressure
/// without its mean.
struct FlowErrors {
  double u = 0, u_max = 0, p = 0, p_max = 0;
};

/// Sets the velocity to exact.u(axis, x, y, z) on the faces; ghosts are not those of the walls yet.
template <class Exact>
void set_velocity(const FluidState& fluid, const Exact& exact) {
  set_faces(fluid.u, fluid.grid,
            [&](std::size_t axis, double x, double y, double z) { return exact.u(axis, x, y, z); });
}

/// `velocity` has u(axis, x, y, z) at the time of the velocity, `pressure` has p(x, y, z).
template <class Velocity, class Pressure>
FlowErrors flow_errors(const FluidState& fluid, const Velocity& velocity,
                       const Pressure& pressure) {
  const Grid& grid = fluid.grid;
  const HostGrid h(grid);
  const auto u = to_host(fluid.u.x), v = to_host(fluid.u.y), w = to_host(fluid.u.z),
             p = to_host(fluid.p);
  const auto p_error = [&](int i, int j, int k) {
    return p(i, j, k) - pressure.p(h.x(i), h.y(j), h.z(k));
  };
  double volume = 0, p_mean = 0;
  for_owned_cells(grid, [&](int i, int j, int k) {
    volume += h.volume(j);
    p_mean += p_error(i, j, k) * h.volume(j);
  });
  p_mean /= volume;
  FlowErrors e;
  for_owned_cells(grid, [&](int i, int j, int k) {
    const double ex = u(i, j, k) - velocity.u(0, h.x_face(i), h.y(j), h.z(k));
    const double ey = j == 0 ? 0 : v(i, j, k) - velocity.u(1, h.x(i), h.y_face(j), h.z(k));
    const double ez = w(i, j, k) - velocity.u(2, h.x(i), h.y(j), h.z_face(k));
    const double ep = p_error(i, j, k) - p_mean;
    e.u += (ex * ex + ey * ey + ez * ez) * h.volume(j) / volume;
    e.p += ep * ep * h.volume(j) / volume;
    e.u_max = std::max({e.u_max, std::abs(ex), std::abs(ey), std::abs(ez)});
    e.p_max = std::max(e.p_max, std::abs(ep));
  });
  e.u = std::sqrt(e.u);
  e.p = std::sqrt(e.p);
  return e;
}

}  // namespace barchan::test
