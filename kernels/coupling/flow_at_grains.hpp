// The flow as it is at each grain: its velocity, and the force of its pressure gradient and stress
// on a volume there. Equations: docs/theory-coupling.md.
#pragma once

#include "kernels/coupling/cell_point_face.hpp"
#include "kernels/coupling/layered_exchange.hpp"
#include "kernels/fluid/interpolation.hpp"
#include "kernels/fluid/momentum.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

/// Forces of the fluid that act.
struct FluidForces {
  bool drag = false, pressure_gradient = false, stress = false, added_mass = false;
  bool buoyancy = false;
  bool lift = false, torque = false;  // GatherShear
  bool wall_drag = false;             // a factor on the drag
  bool mixture_viscosity = false;     // Stresslet
};

/// The first and the last face of a direction, where grains end at a wall though the flow passes.
struct WallFaces {
  int first = -2, last = -2;  // none
  KOKKOS_FORCEINLINE_FUNCTION bool has(int face) const { return face == first || face == last; }
};

/// Fraction alpha_f before it was smoothed, (1 - L^2 lap) alpha_f: undoes the implicit smoothing to
/// round-off.
struct RawFraction {
  GridRef grid;
  ConstFieldRef alpha_f;       // with ghosts
  Real length_squared;         // [m^2]
  WallFaces walls_x, walls_z;  // no gradient there
  FieldRef alpha_raw;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const auto slope_x = [&](int ii) {
      return walls_x.has(ii) ? Real(0) : ddx_at_xface(grid, alpha_f, ii, j, k);
    };
    const auto slope_y = [&](int jj) { return ddy_at_yface(grid, alpha_f, i, jj, k); };
    const auto slope_z = [&](int kk) {
      return walls_z.has(kk) ? Real(0) : ddz_at_zface(grid, alpha_f, i, j, kk);
    };
    const Real laplacian = (slope_x(i + 1) - slope_x(i)) * (1 / grid.dx) +
                           (slope_y(j + 1) - slope_y(j)) * (1 / grid.dy(j)) +
                           (slope_z(k + 1) - slope_z(k)) * (1 / grid.dz);
    alpha_raw(i, j, k) = alpha_f(i, j, k) - length_squared * laplacian;
  }
};

/// Flow at each grain now.
struct FlowAtGrains {
  Kokkos::View<Vec3*> u;            // [m/s], as the drag feels it
  Kokkos::View<Vec3*> du_dt;        // change of u over the last step [m/s^2], interpolated as u
  Kokkos::View<Vec3*> u_grad_u;     // convective acceleration at the centre [m/s^2]
  Kokkos::View<Vec3*> vorticity{};  // [1/s]; with layers the mean over its rows; empty: not read;
                                    // else it lies where GatherShear then puts its result
  Kokkos::View<Vec3*> pressure;     // force of its gradient on a volume [N/m^3]; zero where off
  Kokkos::View<Vec3*> stress;       // force of the stress on a volume [N/m^3]; zero where off
  Kokkos::View<Real*> alpha_l;      // fraction that the drag law reads: with layers the mean over
                                    // its cells before the smoothing, else alpha_f
  Kokkos::View<Real*> alpha_o;      // fluid fraction that the other grains leave in its cells
  Kokkos::View<Real*> slip;         // slip that the law sees [m/s]
  Kokkos::View<Real*> factor;       // factor on the law's beta, whose drag is along u - u_p
  Kokkos::View<Real*> solid_per_fluid;  // largest of its cells and of its momentum cells

  KOKKOS_FORCEINLINE_FUNCTION bool has_vorticity() const { return vorticity.extent(0) > 0; }
  /// Sets the slip for a scheme that knows no neighbours; call it after u is set.
  KOKKOS_FORCEINLINE_FUNCTION void set_whole_slip(int g, const Vec3& u_p) const {
    alpha_o(g) = 1;
    slip(g) = norm(u(g) - u_p);
    factor(g) = 1;
  }
};

/// Fluid fraction as the drag laws take it: at least 0.1.
KOKKOS_INLINE_FUNCTION Real limited_fraction(Real alpha) {
  return Kokkos::clamp(alpha, Real(0.1), Real(1));
}

/// A face vector at the grains' centres, trilinear.
struct AtCentres {
  GridRef grid;
  PeriodicBox box;
  ConstFaceRef f;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<Vec3*> at;
  KOKKOS_FUNCTION void operator()(int g) const {
    at(g) = interpolate_faces(f, PointStencil(grid, box, grains(g).x));
  }
};

/// Velocity, its rate of change and curl, convection and fluid fraction at the grains' centres,
/// trilinear.
struct FlowAtCentres {
  GridRef grid;
  PeriodicBox box;
  ConstFaceRef u, du_dt, u_grad_u;
  ConstFieldRef alpha_f;
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow;
  KOKKOS_FUNCTION void operator()(int g) const {
    const PointStencil at(grid, box, grains(g).x);
    flow.u(g) = interpolate_faces(u, at);
    flow.du_dt(g) = interpolate_faces(du_dt, at);
    flow.u_grad_u(g) = interpolate_faces(u_grad_u, at);
    if (flow.has_vorticity()) flow.vorticity(g) = interpolate_curl(u, grid, at);
    flow.alpha_l(g) = interpolate_cell(alpha_f, at);
    flow.set_whole_slip(g, grains(g).u);
  }
};

/// Velocity and fraction as CFDEM reads them, from the centres of cells.
struct FlowFromCells {
  GridRef grid;
  PeriodicBox box;
  ConstFieldRef x, y, z;  // velocity on cells
  ConstFieldRef alpha_f;
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow;
  KOKKOS_FUNCTION void operator()(int g) const {
    const CellPointFace at(grid, box, grains(g).x);
    flow.u(g) = {at(grid, x), at(grid, y), at(grid, z)};
    flow.alpha_l(g) = at(grid, alpha_f);
    flow.set_whole_slip(g, grains(g).u);
  }
};

/// A vector on cells.
struct CellVectorRef {
  ConstFieldRef x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const CellIndex& c) const {
    return {x(c.i, c.j, c.k), y(c.i, c.j, c.k), z(c.i, c.j, c.k)};
  }
};

/// Means of cell densities, fluid fraction included, over a grain's cells: the adjoint of the
/// deposit. The solid per fluid is that of the fullest of its cells, before the smoothing: as many
/// grains as there are share the fluid.
struct FlowOverCells {
  DepositStencil stencil;
  ConstFieldRef alpha_f, alpha_raw;
  bool with_pressure = false, with_stress = false;
  CellVectorRef pressure{}, stress{};
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow;
  Kokkos::View<const PartOfClump*> part = {};  // empty: all grains are spheres
  KOKKOS_FUNCTION void operator()(int g) const { (*this)(g, stencil(grains(g))); }
  KOKKOS_INLINE_FUNCTION void operator()(int g, const GrainCells& cells) const {
    const Real whole = volume_of_grain(g);
    Real most = 0, mean = 0, own = 0;
    Vec3 of_pressure, of_stress;
    for (int q = 0; q < cells.n; ++q) {
      const CellIndex c = cells.cell[q];
      const Real w = cells.weight(q), here = alpha_raw(c.i, c.j, c.k);
      mean += w * here;
      own += w * w * whole / stencil.grid.cell_volume(c.j);
      most = Kokkos::max(most, (1 - here) / Kokkos::max(alpha_f(c.i, c.j, c.k), Real(1e-3)));
      if (with_pressure) of_pressure += w * pressure(c);
      if (with_stress) of_stress += w * stress(c);
    }
    flow.alpha_l(g) = mean;
    flow.alpha_o(g) = Kokkos::min(mean + own, Real(1));
    flow.solid_per_fluid(g) = most;
    if (with_pressure) flow.pressure(g) = of_pressure;
    if (with_stress) flow.stress(g) = of_stress;
  }

 private:
  /// Volume of a grain; all spheres of a clump count as if they lay in the cells of this one [m^3].
  KOKKOS_FORCEINLINE_FUNCTION Real volume_of_grain(int g) const {
    return sphere_volume(part.extent(0) > 0 ? part(g).d / 2 : grains(g).r);
  }
};

/// Flow in the layers that a grain lies in: velocity along the floor, its rate of change,
/// vorticity. Vertical velocity, convection and fluid fraction are those at its centre; the force
/// densities are means over its cells.
struct LayeredFlow {
  FlowOverCells over_cells;
  PeriodicBox box;
  ConstFaceRef u, du_dt, u_grad_u;
  bool oversubscribed = false;     // momentum cells may get too many grains
  ConstFieldRef solid_x, solid_z;  // solid per volume of momentum cells, with ghosts
  KOKKOS_FUNCTION void operator()(int g) const {
    const FlowAtGrains& flow = over_cells.flow;
    const GrainKinematics grain = over_cells.grains(g);
    const GrainRows rows = over_cells.stencil.rows_of(grain);
    over_cells(g, over_cells.stencil(grain, rows));
    const PointStencil at(over_cells.stencil.grid, box, grain.x, rows.row[0]);
    const Real dense = solid_per_fluid_at(over_cells.alpha_raw, at, rows);
    flow.u(g) = of_rows(u, rows, at, dense);
    flow.du_dt(g) = of_rows(du_dt, rows, at, dense);
    flow.u_grad_u(g) = interpolate_faces(u_grad_u, at);
    set_slip(g, grain.u, at);
    if (flow.has_vorticity()) flow.vorticity(g) = vorticity_of_rows(rows, at);
    if (!oversubscribed) return;
    flow.solid_per_fluid(g) =
        Kokkos::max(flow.solid_per_fluid(g), in_momentum_cells(rows, GrainColumn(at, dense)));
  }

 private:
  /// Sets slip, velocity and factor of the drag. The flow carries alpha_f of its velocity, so the
  /// superficial slip is right: the drag sees s = alpha_f/alpha_l of the slip, twice. Along
  /// surfaces of equal fraction, as over a bed, it knows none of the other grains, whose part in
  /// the solid of the grain's cells is h. So
  ///   F = beta (s_a^2 v + (s^2 - s_a^2) n (n . v)), s_a^2 = 1 + (s^2 - 1) (1 - h).
  KOKKOS_INLINE_FUNCTION void set_slip(int g, const Vec3& u_p, const PointStencil& at) const {
    const FlowAtGrains& flow = over_cells.flow;
    const ConstFieldRef& alpha_f = over_cells.alpha_f;
    const Real s =
        limited_fraction(interpolate_cell(alpha_f, at)) / limited_fraction(flow.alpha_l(g));
    const Real solid = 1 - flow.alpha_l(g), h = solid > 0 ? (1 - flow.alpha_o(g)) / solid : Real(0);
    const Real along_squared = 1 + (s * s - 1) * (1 - h);
    const Real along = Kokkos::sqrt(along_squared);
    const Vec3 change = interpolate_gradient(alpha_f, over_cells.stencil.grid, at);
    const Real size = dot(change, change);
    const Vec3 slip = flow.u(g) - u_p;
    const Vec3 across = (size > 0 ? dot(slip, change) / size : Real(0)) * change;
    flow.slip(g) = norm(along * slip + (s - along) * across);
    flow.factor(g) = along_squared;
    flow.u(g) += (s * s / along_squared - 1) * across;
  }
  /// Solid per fluid in the fullest of the momentum cells that the grain belongs to.
  KOKKOS_INLINE_FUNCTION Real in_momentum_cells(const GrainRows& rows,
                                                const GrainColumn& of) const {
    const ConstFieldRef& alpha_f = over_cells.alpha_f;
    Real most = 0;
    const auto look = [&](Real weight, Real solid, Real fluid) {
      if (weight > 0) most = Kokkos::max(most, solid / Kokkos::max(fluid, Real(1e-3)));
    };
    for (int r = 0; r < rows.n; ++r) {
      const int j = rows.row[r];
      for (int side = 0; side < 2; ++side) {
        const int i = of.i + side, k = of.k + side;
        look(of.x_faces.weight(side), solid_x(i, j, of.k), cell_to_xface(alpha_f, i, j, of.k));
        look(of.z_faces.weight(side), solid_z(of.i, j, k), cell_to_zface(alpha_f, of.i, j, k));
      }
    }
    return most;
  }
  KOKKOS_INLINE_FUNCTION Vec3 of_rows(const ConstFaceRef& f, const GrainRows& rows,
                                      const PointStencil& at, Real solid_per_fluid) const {
    const LayerVelocity v(rows, at, f, solid_per_fluid);
    return {v.x.over_grain, interpolate(f.y, at.centres, at.y_face), v.z.over_grain};
  }
  /// Mean over the parts of a grain in its rows, each at its mean height.
  KOKKOS_INLINE_FUNCTION Vec3 vorticity_of_rows(const GrainRows& rows,
                                                const PointStencil& at) const {
    const GridRef& grid = over_cells.stencil.grid;
    Vec3 mean;
    for (int q = 0; q < rows.n; ++q) {
      const HeightStencil height(grid, rows.height(grid, q), rows.row[q]);
      mean += rows.weight(q) * interpolate_curl(u, grid, at, height);
    }
    return mean;
  }
};

/// Sum over the grains of the forces of the flow's pressure gradient and stress [N].
struct SumOfForces {
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow;
  KOKKOS_FUNCTION void operator()(int g, Vec3& sum) const {
    sum += sphere_volume(grains(g).r) * (flow.pressure(g) + flow.stress(g));
  }
};

}  // namespace barchan
