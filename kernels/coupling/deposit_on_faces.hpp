// Deposits on cells and layers brought to the faces of the flow. Equations:
// docs/theory-coupling.md.
#pragma once

#include "kernels/coupling/deposit.hpp"

namespace barchan {

/// Shares of a cell's content that go to its lower and upper y-face; nothing goes to the walls.
struct FaceShares {
  Real lower, upper;
};
KOKKOS_INLINE_FUNCTION FaceShares y_face_shares(int j, int ny) {
  if (ny == 1) return {0, 0};
  if (j == 0) return {0, 1};
  return j == ny - 1 ? FaceShares{1, 0} : FaceShares{Real(0.5), Real(0.5)};
}

/// A density on y-face j from those in the rows below and above it, integrals kept.
KOKKOS_INLINE_FUNCTION Real spread_to_y_face(const GridRef& grid, Real below, Real above, int j) {
  if (j == 0) return 0;
  return (below * grid.dy(j - 1) * y_face_shares(j - 1, grid.ny).upper +
          above * grid.dy(j) * y_face_shares(j, grid.ny).lower) /
         grid.dy_centre(j);
}

/// Integral of a density on the faces of a cell index over their volumes.
KOKKOS_INLINE_FUNCTION Vec3 over_face_volumes(const GridRef& grid, const Vec3& density, int j) {
  const Real floor = grid.dx * grid.dz, row = floor * grid.dy(j);
  return {density.x * row, density.y * floor * grid.dy_centre(j), density.z * row};
}

/// Spreads cell densities to faces, integrals kept: half of a cell's content goes to each of its
/// two faces. Returns what the fluid loses [N s].
struct SpreadToFaces {
  GridRef grid;
  ConstFieldRef impulse_x, impulse_y, impulse_z;  // on cells, ghosts in x and z valid
  FaceRef given;                                  // on faces

  KOKKOS_INLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    // The fluid gets the opposite of what the grains got.
    const Real below = j > 0 ? impulse_y(i, j - 1, k) : 0;
    const Vec3 lost{cell_to_xface(impulse_x, i, j, k),
                    spread_to_y_face(grid, below, impulse_y(i, j, k), j),
                    cell_to_zface(impulse_z, i, j, k)};
    given.x(i, j, k) = -lost.x;
    given.y(i, j, k) = -lost.y;
    given.z(i, j, k) = -lost.z;
    return over_face_volumes(grid, lost, j);
  }
};

/// Brings the deposits of layers to faces (those along the floor are on theirs already), and the
/// coefficients of the interlayer drag.
struct LayersToFaces {
  GridRef grid;
  Deposits deposits;
  FaceRef given;
  FieldRef interlayer_drag_x, interlayer_drag_z;

  KOKKOS_FORCEINLINE_FUNCTION Real impulse(Deposits::Quantity q, int i, int j, int k) const {
    return density_of_deposit(grid, deposits, deposits.impulse, q, i, j, k);
  }
  KOKKOS_INLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    using enum Deposits::Quantity;
    const Real below = j > 0 ? impulse(kImpulseY, i, j - 1, k) : 0;
    const Vec3 lost{impulse(kImpulseX, i, j, k),
                    spread_to_y_face(grid, below, impulse(kImpulseY, i, j, k), j),
                    impulse(kImpulseZ, i, j, k)};
    given.x(i, j, k) = -lost.x;
    given.y(i, j, k) = -lost.y;
    given.z(i, j, k) = -lost.z;
    const auto interlayer_drag = [&](Deposits::Quantity q) {
      return density_of_deposit(grid, deposits, deposits.interlayer_drag, q, i, j, k);
    };
    interlayer_drag_x(i, j, k) = interlayer_drag(kInterlayerDragX);
    interlayer_drag_z(i, j, k) = interlayer_drag(kInterlayerDragZ);
    return over_face_volumes(grid, lost, j);
  }
};

}  // namespace barchan
