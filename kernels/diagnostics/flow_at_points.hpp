// Flow at points at rest: velocity, pressure, wall shear stress.
#pragma once

#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/interpolation.hpp"

namespace barchan {

struct FlowAtPoint {
  Vec3 u;           // velocity [m/s]
  Real p = 0;       // pressure without the hydrostatic and driving parts [Pa]
  Vec2 wall_shear;  // shear stress of the fluid on the floor below [Pa]
  static constexpr int n_numbers = 6;
};

/// Reads the flow at points, trilinear between the nodes of each staggering. Ranks that do not own
/// the column of a point give zero, so that the sum over ranks has the bits of the one that does.
/// Ghosts must be valid.
struct ReadFlowAtPoints {
  GridRef grid;
  ConstFaceRef u;
  ConstFieldRef p;
  Real wall_viscosity;  // rho nu at the floor; 0 for free slip [Pa s]
  Kokkos::View<const Vec3*> points;
  Kokkos::View<FlowAtPoint*> values;

  KOKKOS_FUNCTION void operator()(int n) const {
    values(n) = {};
    const PeriodicBox box = grid.box(true);
    if (!owns(box.wrap(points(n)))) return;
    const PointStencil at(grid, box, points(n));
    values(n) = {.u = interpolate_faces(u, at),
                 .p = interpolate_cell(p, at),
                 .wall_shear = {wall_viscosity * slope(u.x, at.x_faces),
                                wall_viscosity * slope(u.z, at.z_faces)}};
  }

 private:
  KOKKOS_INLINE_FUNCTION bool owns(const Vec3& inside) const {
    const int i = Kokkos::min(GridRef::cell_along(inside.x, grid.dx), grid.nx_all - 1);
    const int k = Kokkos::min(GridRef::cell_along(inside.z, grid.dz), grid.nz_all - 1);
    return i >= grid.i_begin && i < grid.i_begin + grid.nx && k >= grid.k_begin &&
           k < grid.k_begin + grid.nz;
  }
  /// Slope of a velocity at the floor [1/s].
  KOKKOS_INLINE_FUNCTION Real slope(const ConstFieldRef& f, const PlaneStencil& at) const {
    const WallShear wall{.grid = grid, .u = f, .row = 0, .u_wall = 0};
    Real sum = 0;
    for (int side = 0; side < 2; ++side)
      sum += at.front[side] * wall(at.i + side, 0, at.k) +
             at.back[side] * wall(at.i + side, 0, at.k + 1);
    return sum;
  }
};

}  // namespace barchan
