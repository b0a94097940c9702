// Sums over the flow for reports.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// A largest value and sums, of a cell or of many.
struct LargestAndSums {
  Real largest = 0;
  Vec2 sum;
};

/// A cell field weighted with the height of its row.
struct HeightSum {
  GridRef grid;
  ConstFieldRef a;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return a(i, j, k) * grid.dy(j);
  }
};

/// alpha u_x dy on x-faces [m^2/s].
struct FlowRate {
  GridRef grid;
  ConstFieldRef u, alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return cell_to_xface(alpha, i, j, k) * u(i, j, k) * grid.dy(j);
  }
};

/// alpha w dy on z-faces [m^2/s].
struct FlowRateAcross {
  GridRef grid;
  ConstFieldRef w, alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return cell_to_zface(alpha, i, j, k) * w(i, j, k) * grid.dy(j);
  }
};

/// Courant number of a velocity [-].
struct Courant {
  GridRef grid;
  ConstFaceRef u;
  Real dt;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return courant_number({u.x(i, j, k), u.y(i, j, k), u.z(i, j, k)},
                          {grid.dx, grid.dy_centre(j), grid.dz}, dt);
  }
};

/// Largest velocity along x or z [m/s].
struct FastestAlong {
  ConstFaceRef u;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return Kokkos::max(Kokkos::abs(u.x(i, j, k)), Kokkos::abs(u.z(i, j, k)));
  }
};

/// alpha |u|^2 dy / 2 with the face values' own volumes [m^3/s^2]: the energy that the convection
/// conserves. Ghosts of alpha must be valid.
struct KineticEnergy {
  GridRef grid;
  ConstFaceRef u;
  ConstFieldRef alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real x = u.x(i, j, k), y = u.y(i, j, k), z = u.z(i, j, k);
    const Real horizontal =
        cell_to_xface(alpha, i, j, k) * x * x + cell_to_zface(alpha, i, j, k) * z * z;
    const Real vertical = cell_to_yface(grid, alpha, i, j, k) * y * y;
    return Real(0.5) * (horizontal * grid.dy(j) + vertical * grid.dy_centre(j));
  }
};

/// Slope of U towards a wall from the row next to it [1/s]: that of `row`, seen from a wall that
/// moves with u_wall [m/s].
struct WallShear {
  GridRef grid;
  ConstFieldRef u;
  int row;
  Real u_wall;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return j == row ? 2 * (u(i, j, k) - u_wall) / grid.dy(j) : 0;
  }
};

}  // namespace barchan
