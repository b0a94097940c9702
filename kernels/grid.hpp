// The structured staggered (MAC) grid and the fields on it.
#pragma once

#include "kernels/vec3.hpp"

namespace barchan {

/// Owned cells 0..n-1 in each direction, one ghost layer (-1 and n) around them.
/// Cell (i,j,k) has its x-face (i,j,k) at x = x0 + i dx, its y-face at y_face(j), its z-face at
/// z = z0 + k dz: a face carries the index of the cell on its upper side. Uniform in x and z,
/// stretched in y. The geometry of ghost rows mirrors the first row inside.
struct Grid {
  int nx = 0, ny = 0, nz = 0;
  Real dx = 0, dz = 0;             // spacing [m]
  Real x0 = 0, z0 = 0;             // corner of the owned part [m]
  Real lx = 0, ly = 0, lz = 0;     // extent of the owned part [m]
  Kokkos::View<Real*> y_face_;     // [ny + 3], faces -1 .. ny + 1
  Kokkos::View<Real*> y_centre_;   // [ny + 2], cells -1 .. ny

  KOKKOS_INLINE_FUNCTION Real y_face(int j) const { return y_face_(j + 1); }
  KOKKOS_INLINE_FUNCTION Real y_centre(int j) const { return y_centre_(j + 1); }
  KOKKOS_INLINE_FUNCTION Real x_face(int i) const { return x0 + i * dx; }
  KOKKOS_INLINE_FUNCTION Real x_centre(int i) const { return x0 + (i + Real(0.5)) * dx; }
  KOKKOS_INLINE_FUNCTION Real z_face(int k) const { return z0 + k * dz; }
  KOKKOS_INLINE_FUNCTION Real z_centre(int k) const { return z0 + (k + Real(0.5)) * dz; }
  /// Height of row j [m].
  KOKKOS_INLINE_FUNCTION Real dy(int j) const { return y_face_(j + 2) - y_face_(j + 1); }
  /// Distance between the centres on either side of y-face j [m].
  KOKKOS_INLINE_FUNCTION Real dy_centre(int j) const { return y_centre_(j + 1) - y_centre_(j); }
  KOKKOS_INLINE_FUNCTION Real cell_volume(int j) const { return dx * dy(j) * dz; }

  /// The same as row_of(y), found from a row nearby.
  KOKKOS_INLINE_FUNCTION int row_near(Real y, int row) const {
    while (row > 0 && y < y_face(row)) --row;
    while (row < ny - 1 && y >= y_face(row + 1)) ++row;
    return row;
  }
  /// Row whose interval [y_face(j), y_face(j+1)) holds y; clamped to 0..ny-1.
  KOKKOS_INLINE_FUNCTION int row_of(Real y) const {
    int low = 0, high = ny;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      if (y_face(middle) <= y) {
        low = middle;
      } else {
        high = middle;
      }
    }
    return low;
  }
};

/// A scalar on the grid with its ghost layer; x runs fastest in memory on every backend.
/// Indexing is by cell, ghosts at -1 and n. The raw origin keeps inner loops vectorisable.
struct Field {
  using Storage = Kokkos::View<Real***, Kokkos::LayoutLeft>;
  Storage storage;  // (nx + 2, ny + 2, nz + 2)
  Real* origin = nullptr;
  int stride_y = 0, stride_z = 0;

  Field() = default;
  Field(const char* label, const Grid& grid)
      : storage(label, grid.nx + 2, grid.ny + 2, grid.nz + 2),
        stride_y(grid.nx + 2),
        stride_z((grid.nx + 2) * (grid.ny + 2)) {
    origin = storage.data() + 1 + stride_y + stride_z;
  }
  KOKKOS_INLINE_FUNCTION Real& operator()(int i, int j, int k) const {
    return origin[i + stride_y * j + stride_z * k];
  }
};

/// A vector on the faces: x component on x-faces, y on y-faces, z on z-faces.
struct FaceVector {
  Field x, y, z;
};

}  // namespace barchan
