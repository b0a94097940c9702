// Layered exchange: the part of a grain in a row of cells feels the fluid of that row at the
// grain's centre, and that fluid loses what it gave. Source and reason: docs/theory-coupling.md,
// "Layered exchange".
#pragma once

#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/interpolation.hpp"

namespace barchan {

/// The smaller of two slopes, zero where they differ in sign (minmod; Roe 1986). Without branches,
/// whose outcome would be as good as random.
KOKKOS_FORCEINLINE_FUNCTION Real limited_slope(Real a, Real b) {
  return Kokkos::max(Real(0), Kokkos::min(a, b)) + Kokkos::min(Real(0), Kokkos::max(a, b));
}

/// Interlayer drag between rows j - 1 and j through one grain, over beta_p dt: C_j of
/// docs/theory-coupling.md, "Interlayer drag",
///   sum over pairs of its rows a < j <= b of w_a w_b (b - a).
/// It is at least as stiff as the drag itself (tests/physics/interlayer_drag_test.cpp). Its sum
/// over all j is at most kDividedOffsets^2 / 4. A grain has at most
/// kDividedOffsets rows.
KOKKOS_INLINE_FUNCTION Real interlayer_drag_below(const GrainRows& rows, int j) {
  Real below = 0, above = 0, moment_below = 0, moment_above = 0;
  for (int q = 0; q < rows.n; ++q) {
    const Real w = rows.weight(q), up = rows.row[q] - j;
    const bool under = up < 0;
    below += under ? w : 0, moment_below -= under ? w * up : 0;
    above += under ? 0 : w, moment_above += under ? 0 : w * up;
  }
  return below * moment_above + above * moment_below;
}

/// Solid volume per fluid volume in the cell of a grain's centre.
KOKKOS_INLINE_FUNCTION Real solid_per_fluid_at(const ConstFieldRef& alpha_f, const PointStencil& at,
                                               const GrainRows& rows) {
  const Real fluid = alpha_f(at.x_face.i, rows.row[0], at.z_face.i);
  return Kokkos::max(1 - fluid, Real(0)) / Kokkos::max(fluid, Real(0.1));
}

/// Two faces of a grain's column across a direction of the flow, and the part of the grain that
/// belongs to the momentum cell of each. A grain alone in its fluid belongs to both by its
/// distance. Among others it belongs to the nearer one, except close to the middle: two pieces of
/// fluid that many grains join would be dragged by each other, and at the surface of a bed one of
/// them is open.
struct GrainFaces {
  int first = 0;
  Real of_second = 0;  // the other face has the rest
  KOKKOS_INLINE_FUNCTION GrainFaces(const LinearStencil& face, Real solid_per_fluid)
      : first(face.i) {
    const Real half = Real(0.5), width = 1 / (1 + kNarrowing * solid_per_fluid);
    of_second = Kokkos::clamp((face.t - half) / width + half, Real(0), Real(1));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real weight(int side) const {
    return side == 0 ? 1 - of_second : of_second;
  }
  /// The side that has more of the grain. Among others the grain seldom belongs to both.
  KOKKOS_FORCEINLINE_FUNCTION int main_side() const { return of_second > Real(0.5) ? 1 : 0; }
  /// Limiter phi: the part of K = dt beta_p/m_f with which a grain joins the fluid at its two
  /// faces. The exchange is explicit: a grain takes c (1 - c) K of their difference, and must not
  /// take more than there is.
  KOKKOS_FORCEINLINE_FUNCTION Real limiter(Real K) const {
    return Kokkos::min(Real(1), kLargestExchange / (of_second * (1 - of_second) * K));
  }

 private:
  // Largest c (1 - c) K of a face. Grains may join it on both sides: up to 1/2 is stable, up to 1/4
  // no velocity overshoots another.
  static constexpr Real kLargestExchange = 0.25;
  // A thirteenth of the grains join both faces at a solid fraction of 3/5.
  static constexpr Real kNarrowing = 8;
};

/// A velocity along the floor in the columns of momentum cells around the faces of a grain.
struct ColumnVelocity {
  const Real* first;      // at the first face, in row 0
  int to_face;            // to the other face
  int stride_y, to_side;  // to the next row; to the next column across the flow
  Real across;  // distance of the grain's centre from the middle of the column, over its width

  KOKKOS_FORCEINLINE_FUNCTION ColumnVelocity at_face(int side) const {
    return {first + side * to_face, to_face, stride_y, to_side, across};
  }
  KOKKOS_FORCEINLINE_FUNCTION Real in_row(int j, int side = 0) const {
    return first[static_cast<std::ptrdiff_t>(stride_y) * j + side * to_side];
  }
  /// Change of the velocity off the middle, along a slope that makes no new extremum.
  KOKKOS_FORCEINLINE_FUNCTION Real off_middle(int j, Real here) const {
    return across * limited_slope(here - in_row(j, -1), in_row(j, 1) - here);
  }
};

/// A velocity along the floor as a grain sees it at its two faces [m/s].
struct VelocityAtFaces {
  Real in_row[2][kDividedOffsets];
  Real mean[2];         // over the rows
  Real over_grain = 0;  // mean over both
};

/// Momentum cells that a grain belongs to: those of its rows at these faces of its column.
struct GrainColumn {
  int i, k;
  GrainFaces x_faces, z_faces;  // across x, across z

  KOKKOS_INLINE_FUNCTION GrainColumn(const PointStencil& at, Real solid_per_fluid)
      : i(at.x_face.i),
        k(at.z_face.i),
        x_faces(at.x_face, solid_per_fluid),
        z_faces(at.z_face, solid_per_fluid) {}
};

/// Velocity along the floor in each row of a grain, x and z [m/s], from the momentum cells that the
/// grain belongs to, with slopes upwards and across the flow that make no new extremum. A grain in
/// a linear shear sees the shear. At the surface of a bed, where the flow above and beside is a
/// hundred times faster than between the grains, no grain sees the one for the other.
struct LayerVelocity : GrainColumn {
  const GrainRows& rows;
  VelocityAtFaces x, z;
  Real solid;  // solid fraction in the cell of its centre

  KOKKOS_INLINE_FUNCTION LayerVelocity(const GrainRows& of_grain, const PointStencil& at,
                                       const ConstFaceRef& u, Real solid_per_fluid)
      : GrainColumn(at, solid_per_fluid),
        rows(of_grain),
        solid(solid_per_fluid / (1 + solid_per_fluid)) {
    const Real half = Real(0.5);
    set(x, x_faces, {&u.x(i, 0, k), 1, u.x.stride_y, u.x.stride_z, at.z_face.t - half});
    set(z, z_faces, {&u.z(i, 0, k), u.z.stride_z, u.z.stride_y, 1, at.x_face.t - half});
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void set(VelocityAtFaces& v, const GrainFaces& faces,
                                       const ColumnVelocity& u) const {
    const int main = faces.main_side();
    add(v, main, faces, u);
    if (faces.weight(1 - main) > 0) add(v, 1 - main, faces, u);
  }
  KOKKOS_FORCEINLINE_FUNCTION void add(VelocityAtFaces& v, int side, const GrainFaces& faces,
                                       const ColumnVelocity& u) const {
    v.mean[side] = in_rows(u.at_face(side), v.in_row[side]);
    v.over_grain += faces.weight(side) * v.mean[side];
  }
  /// Sets the velocity in each row; returns the mean over the rows.
  KOKKOS_INLINE_FUNCTION Real in_rows(const ColumnVelocity& u, Real (&v)[kDividedOffsets]) const {
    Real mean = 0;
    for (int r = 0; r < rows.n; ++r) {
      const int j = rows.row[r];
      const Real below = u.in_row(j - 1), here = u.in_row(j), above = u.in_row(j + 1);
      v[r] =
          here + u.off_middle(j, here) +
          limited_slope((here - below) * rows.over_lower[r], (above - here) * rows.over_upper[r]);
      mean += rows.weight(r) * v[r];
    }
    return mean;
  }
};

/// Velocities and impulses that pass between a grain and the rows that it lies in.
struct LayerExchange {
  static constexpr bool layered = true;
  DepositStencil stencil;
  PeriodicBox box;
  ConstFaceRef u;
  ConstFieldRef alpha_f;  // fluid fraction before the smoothing

  KOKKOS_INLINE_FUNCTION LayerVelocity velocity(const GrainRows& rows,
                                                const GrainKinematics& grain) const {
    const PointStencil at(stencil.grid, box, grain.x, rows.row[0]);
    return {rows, at, u, solid_per_fluid_at(alpha_f, at, rows)};
  }
  KOKKOS_INLINE_FUNCTION GrainColumn column(const GrainRows& rows,
                                            const GrainKinematics& grain) const {
    const PointStencil at(stencil.grid, box, grain.x, rows.row[0]);
    return {at, solid_per_fluid_at(alpha_f, at, rows)};
  }
  /// Face of a momentum cell. The flow is periodic: the last face is the first, or lies in the
  /// ghosts where the grid is cut.
  KOKKOS_INLINE_FUNCTION CellIndex x_face(const GrainColumn& of, int side, int j) const {
    const int face = of.x_faces.first + side;
    return {face == stencil.grid.nx_all ? 0 : face, j, of.k};
  }
  KOKKOS_INLINE_FUNCTION CellIndex z_face(const GrainColumn& of, int side, int j) const {
    const int face = of.z_faces.first + side;
    return {of.i, j, face == stencil.grid.nz_all ? 0 : face};
  }
};

}  // namespace barchan
