// Values of a result frame: the flow brought to the cell centres, the grains taken apart.
#pragma once

#include <cstdint>

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/clump.hpp"

namespace barchan {

/// Single precision, x fastest, no ghosts: rows (nz, ny, nx) of a file.
using FrameField = Kokkos::View<float***, Kokkos::LayoutLeft>;

/// Mean of the two faces of a cell; `di, dj, dk` is the step from the lower to the upper one, zero
/// for a field of cells.
struct AverageToFrame {
  ConstFieldRef face;
  int di = 0, dj = 0, dk = 0;
  FrameField out;
  int i0 = 0, j0 = 0, k0 = 0;  // the cell of the first entry of `out`
  KOKKOS_FUNCTION void operator()(int i, int j, int k) const {
    out(i - i0, j - j0, k - k0) =
        static_cast<float>(0.5 * (face(i, j, k) + face(i + di, j + dj, k + dk)));
  }
};

/// Rows (n, 1) or (n, 3) of a file.
template <class T>
using FrameRows = Kokkos::View<T**, Kokkos::LayoutRight>;

template <class T, class Number>
KOKKOS_INLINE_FUNCTION void store(const FrameRows<T>& out, int p, const Number& number) {
  out(p, 0) = static_cast<T>(number);
}
template <class T>
KOKKOS_INLINE_FUNCTION void store(const FrameRows<T>& out, int p, const Vec3& v) {
  out(p, 0) = static_cast<T>(v.x);
  out(p, 1) = static_cast<T>(v.y);
  out(p, 2) = static_cast<T>(v.z);
}

template <class T>
KOKKOS_INLINE_FUNCTION void store(const FrameRows<T>& out, int p, const Quaternion& q) {
  out(p, 0) = static_cast<T>(q.w);
  out(p, 1) = static_cast<T>(q.x);
  out(p, 2) = static_cast<T>(q.y);
  out(p, 3) = static_cast<T>(q.z);
}

/// Stores what `value(p)` gives for each grain p, a number, vector or rotation. An array is a
/// `value`, too.
template <class T, class Value>
struct StoreRows {
  Value value;
  FrameRows<T> out;
  KOKKOS_FUNCTION void operator()(int p) const { store(out, p, value(p)); }
};

/// Orientation of a clump.
struct OrientationOf {
  Kokkos::View<const ClumpMotion*> clump;
  KOKKOS_FUNCTION Quaternion operator()(int p) const { return clump(p).q; }
};

/// Position [m]: the image within the box, from 0 to below its extents also as a T.
template <class T>
struct PositionOf {
  Kokkos::View<const GrainKinematics*> grains;
  PeriodicBox box;
  KOKKOS_FUNCTION Vec3 operator()(int p) const {
    Vec3 x = box.wrap(grains(p).x);
    if (box.lx > 0 && static_cast<T>(x.x) >= box.lx) x.x = 0;
    if (box.lz > 0 && static_cast<T>(x.z) >= box.lz) x.z = 0;
    return x;
  }
};

/// Diameter [m].
struct DiameterOf {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION Real operator()(int p) const { return 2.0 * grains(p).r; }
};

/// Velocity [m/s].
struct VelocityOf {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION Vec3 operator()(int p) const { return grains(p).u; }
};

/// Angular velocity [rad/s].
struct SpinOf {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION Vec3 operator()(int p) const { return grains(p).omega; }
};

/// Number in a list, -1 for `none`.
struct NumberInList {
  Kokkos::View<const std::uint8_t*> number;
  std::uint8_t none;
  KOKKOS_FUNCTION int operator()(int p) const { return number(p) == none ? -1 : number(p); }
};

}  // namespace barchan
