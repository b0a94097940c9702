// Values of a result frame: the flow brought to the cell centres, the grains taken apart.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/grain.hpp"

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

/// Rows (n, 3) of a file.
template <class T>
using FrameVectors = Kokkos::View<T* [3], Kokkos::LayoutRight>;

template <class T>
KOKKOS_INLINE_FUNCTION void store(const FrameVectors<T>& out, int p, const Vec3& v) {
  out(p, 0) = static_cast<T>(v.x);
  out(p, 1) = static_cast<T>(v.y);
  out(p, 2) = static_cast<T>(v.z);
}

/// Stores the image of a position within the box, from 0 to below its extents also as a T.
template <class T>
KOKKOS_INLINE_FUNCTION void store(const FrameVectors<T>& out, int p, const Vec3& x,
                                  const PeriodicBox& box) {
  store(out, p, box.wrap(x));
  if (box.lx > 0 && out(p, 0) >= box.lx) out(p, 0) = 0;
  if (box.lz > 0 && out(p, 2) >= box.lz) out(p, 2) = 0;
}

/// Positions [m] of the grains.
template <class T>
struct FramePositions {
  Kokkos::View<const GrainKinematics*> grains;
  PeriodicBox box;
  FrameVectors<T> x;
  KOKKOS_FUNCTION void operator()(int p) const { store(x, p, grains(p).x, box); }
};

/// Diameter [m], velocity [m/s] and spin [rad/s] of each grain.
struct FrameArrays {
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<double*> d;
  FrameVectors<float> u, omega;
  KOKKOS_FUNCTION void operator()(int p) const {
    const GrainKinematics grain = grains(p);
    d(p) = 2.0 * grain.r;
    store(u, p, grain.u);
    store(omega, p, grain.omega);
  }
};

struct SplitVectors {
  Kokkos::View<const Vec3*> vectors;
  FrameVectors<float> out;
  KOKKOS_FUNCTION void operator()(int p) const { store(out, p, vectors(p)); }
};

}  // namespace barchan
