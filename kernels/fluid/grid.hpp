// The structured staggered (MAC) grid and the fields on it.
#pragma once

#include <cstddef>
#include <type_traits>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Owned cells 0..n-1 in each direction, one ghost layer (-1 and n) around them.
/// Cell (i,j,k) has its x-face (i,j,k) at x_face(i), its y-face at y_face(j), its z-face at
/// z_face(k): a face carries the index of the cell on its upper side. Uniform in x and z, stretched
/// in y. The corner of the domain is the origin. The geometry of ghost rows mirrors the first row
/// inside.
struct GridExtents {
  int nx = 0, ny = 0, nz = 0;
  int nx_all = 0, nz_all = 0;    // cells of all ranks together
  Real dx = 0, dz = 0;           // spacing [m]
  int i_begin = 0, k_begin = 0;  // the first owned cell among those of all ranks
  Real lx = 0, ly = 0, lz = 0;   // extent of the domain, of all ranks [m]
};

/// `Rows` holds the heights: a Kokkos view (src/parallel/grid.hpp) or a bare pointer (GridRef).
template <class Rows>
struct BasicGrid : GridExtents {
  Rows y_face_{};    // [ny + 3], faces -1 .. ny + 1
  Rows y_centre_{};  // [ny + 2], cells -1 .. ny
  Rows row_at_{};    // [kParts ny] row at the lower end of each of equal parts of the height
  static constexpr int kParts = 8;

  KOKKOS_FORCEINLINE_FUNCTION Real y_face(int j) const { return y_face_[j + 1]; }
  KOKKOS_FORCEINLINE_FUNCTION Real y_centre(int j) const { return y_centre_[j + 1]; }
  KOKKOS_FORCEINLINE_FUNCTION Real x_face(int i) const { return (i_begin + i) * dx; }
  KOKKOS_FORCEINLINE_FUNCTION Real x_centre(int i) const {
    return x_face(0) + (i + Real(0.5)) * dx;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z_face(int k) const { return (k_begin + k) * dz; }
  KOKKOS_FORCEINLINE_FUNCTION Real z_centre(int k) const {
    return z_face(0) + (k + Real(0.5)) * dz;
  }
  /// Height of row j [m].
  KOKKOS_FORCEINLINE_FUNCTION Real dy(int j) const { return y_face_[j + 2] - y_face_[j + 1]; }
  /// Distance between the centres on either side of y-face j [m].
  KOKKOS_FORCEINLINE_FUNCTION Real dy_centre(int j) const {
    return y_centre_[j + 1] - y_centre_[j];
  }
  KOKKOS_FORCEINLINE_FUNCTION Real cell_volume(int j) const { return dx * dy(j) * dz; }
  /// The domain: the flow is always periodic along z, for grains maybe not along x.
  PeriodicBox box(bool periodic_x) const { return {periodic_x ? lx : 0, lz}; }
  /// Index along x or z among the cells of all ranks, the same bits on each of them.
  KOKKOS_FORCEINLINE_FUNCTION static int cell_along(Real x, Real spacing) {
    return static_cast<int>(Kokkos::floor(x * (1 / spacing)));
  }

  /// Row of y, as row_of(y) has it, found from a row nearby.
  KOKKOS_INLINE_FUNCTION int row_near(Real y, int row) const {
    while (row > 0 && y < y_face(row)) --row;
    while (row < ny - 1 && y >= y_face(row + 1)) ++row;
    return row;
  }

  /// Row whose interval [y_face(j), y_face(j+1)) holds y; clamped to 0..ny-1.
  KOKKOS_INLINE_FUNCTION int row_of(Real y) const {
    const Real part = y > 0 ? Kokkos::min(y * (kParts * ny / ly), Real(kParts * ny - 1)) : 0;
    return row_near(y, static_cast<int>(row_at_[static_cast<int>(part)]));
  }
};

/// The grid as kernels see it: trivially copyable, valid while the grid lives that
/// it was made from.
using GridRef = BasicGrid<const Real*>;

/// A field as kernels see it: trivially copyable, so that a compiler can keep it in registers.
template <class Value>
struct BasicFieldRef {
  Value* origin = nullptr;
  int stride_y = 0, stride_z = 0;

  /// The row first: its address does not depend on i, and compilers then see plain strides.
  KOKKOS_FORCEINLINE_FUNCTION Value& operator()(int i, int j, int k) const {
    return (origin + (static_cast<std::ptrdiff_t>(stride_y) * j +
                      static_cast<std::ptrdiff_t>(stride_z) * k))[i];
  }
  // NOLINTNEXTLINE(google-explicit-constructor): what can be written can be read
  template <class Other>
  requires(!std::is_const_v<Value> &&
           std::is_same_v<Other, const Value>) KOKKOS_FORCEINLINE_FUNCTION
  operator BasicFieldRef<Other>() const {
    return {origin, stride_y, stride_z};
  }
};
using FieldRef = BasicFieldRef<Real>;             // that kernels write
using ConstFieldRef = BasicFieldRef<const Real>;  // that they read

/// A scalar on the grid with its ghost layer; x runs fastest in memory on every backend.
/// Indexing is by cell, ghosts at -1 and n. The raw origin keeps inner loops vectorisable. Copies
/// share their values; a const Field can only be read.
struct Field {
  using Storage = Kokkos::View<Real***, Kokkos::LayoutLeft>;
  Storage storage;  // (nx + 2, ny + 2, nz + 2)
  Real* origin = nullptr;
  int stride_y = 0, stride_z = 0;

  Field() = default;
  explicit Field(const Storage& values)
      : storage(values),
        stride_y(values.extent_int(0)),
        stride_z(values.extent_int(0) * values.extent_int(1)) {
    origin = storage.data() + 1 + stride_y + stride_z;
  }
  Field(const char* label, const GridRef& grid)
      : Field(Storage(std::string(label), grid.nx + 2, grid.ny + 2, grid.nz + 2)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a Field is one
  KOKKOS_FORCEINLINE_FUNCTION operator FieldRef() { return {origin, stride_y, stride_z}; }
  // NOLINTNEXTLINE(google-explicit-constructor): a const Field is one
  KOKKOS_FORCEINLINE_FUNCTION operator ConstFieldRef() const {
    return {origin, stride_y, stride_z};
  }
};

/// A vector on the faces: x component on x-faces, y on y-faces, z on z-faces.
template <class Component>
struct BasicFaceVector {
  Component x, y, z;
  // NOLINTNEXTLINE(google-explicit-constructor): as its components convert
  template <class Other>
  requires(std::is_convertible_v<Component&, Other>) KOKKOS_FORCEINLINE_FUNCTION
  operator BasicFaceVector<Other>() {
    return {x, y, z};
  }
  // NOLINTNEXTLINE(google-explicit-constructor): as its components convert
  template <class Other>
  requires(std::is_convertible_v<const Component&, Other>) KOKKOS_FORCEINLINE_FUNCTION
  operator BasicFaceVector<Other>() const {
    return {x, y, z};
  }
};
using FaceVector = BasicFaceVector<Field>;
using FaceRef = BasicFaceVector<FieldRef>;            // that kernels write
using ConstFaceRef = BasicFaceVector<ConstFieldRef>;  // that they read

}  // namespace barchan
