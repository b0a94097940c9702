// The pressure equation -div(c grad p) = b and what surrounds it.
#pragma once

#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/momentum.hpp"
#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// c = alpha on faces: how easily pressure moves the mixture's fluid. Zero on the wall below; the
/// wall above is never written.
struct UpdateMobility {
  GridRef grid;
  ConstFieldRef alpha;
  FaceRef c;

  /// Returns what c_x dy, alpha dy and c_z dy are above dy: the first and the last are what a unit
  /// driving force would add to the flow rate here.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    const Real inside = j > 0 ? Real(1) : Real(0), dy = grid.dy(j);
    const Real cx = cell_to_xface(alpha, i, j, k), cz = cell_to_zface(alpha, i, j, k);
    c.x(i, j, k) = cx;
    c.y(i, j, k) = inside * cell_to_yface(grid, alpha, i, j, k);
    c.z(i, j, k) = cz;
    return {(cx - 1) * dy, (alpha(i, j, k) - 1) * dy, (cz - 1) * dy};
  }
};

/// -div(c grad p) in a cell; c vanishes on walls, so ghosts of p behind them do not matter.
KOKKOS_FORCEINLINE_FUNCTION Real pressure_operator(const GridRef& grid, const ConstFaceRef& c,
                                                   const ConstFieldRef& p, int i, int j, int k) {
  const Real centre = p(i, j, k);
  const Real x =
      c.x(i, j, k) * (centre - p(i - 1, j, k)) + c.x(i + 1, j, k) * (centre - p(i + 1, j, k));
  const Real y = c.y(i, j, k) * (centre - p(i, j - 1, k)) * (1 / grid.dy_centre(j)) +
                 c.y(i, j + 1, k) * (centre - p(i, j + 1, k)) * (1 / grid.dy_centre(j + 1));
  const Real z =
      c.z(i, j, k) * (centre - p(i, j, k - 1)) + c.z(i, j, k + 1) * (centre - p(i, j, k + 1));
  return x * (1 / (grid.dx * grid.dx)) + y * (1 / grid.dy(j)) + z * (1 / (grid.dz * grid.dz));
}

/// E p = -div((c - 1) grad p) in a cell: what grains add to the operator of clear fluid. Zero where
/// c is one on all faces inside.
KOKKOS_FORCEINLINE_FUNCTION Real obstruction(const GridRef& grid, const ConstFaceRef& c,
                                             const ConstFieldRef& p, int i, int j, int k) {
  const Real centre = p(i, j, k);
  const Real below = j > 0 ? Real(1) : Real(0), above = j + 1 < grid.ny ? Real(1) : Real(0);
  const Real x = (c.x(i, j, k) - 1) * (centre - p(i - 1, j, k)) +
                 (c.x(i + 1, j, k) - 1) * (centre - p(i + 1, j, k));
  const Real y =
      (c.y(i, j, k) - below) * (centre - p(i, j - 1, k)) * (1 / grid.dy_centre(j)) +
      (c.y(i, j + 1, k) - above) * (centre - p(i, j + 1, k)) * (1 / grid.dy_centre(j + 1));
  const Real z = (c.z(i, j, k) - 1) * (centre - p(i, j, k - 1)) +
                 (c.z(i, j, k + 1) - 1) * (centre - p(i, j, k + 1));
  return x * (1 / (grid.dx * grid.dx)) + y * (1 / grid.dy(j)) + z * (1 / (grid.dz * grid.dz));
}

/// Diagonal of the pressure operator [1/m^2].
KOKKOS_FORCEINLINE_FUNCTION Real pressure_diagonal(const GridRef& grid, const ConstFaceRef& c,
                                                   int i, int j, int k) {
  return (c.x(i, j, k) + c.x(i + 1, j, k)) * (1 / (grid.dx * grid.dx)) +
         (c.y(i, j, k) / grid.dy_centre(j) + c.y(i, j + 1, k) / grid.dy_centre(j + 1)) *
             (1 / grid.dy(j)) +
         (c.z(i, j, k) + c.z(i, j, k + 1)) * (1 / (grid.dz * grid.dz));
}

/// b = -(rho / dt) [div(alpha u) + (alpha - alpha_before) / dt] of -div(c grad p) = b [Pa/m^2],
/// with the drive along x (force per mass times dt) added through c.
/// Where the fraction is uniform, alpha is one and c is not looked at.
template <Fraction fraction>
struct PressureSource {
  GridRef grid;
  ConstFaceRef u;
  ConstFieldRef alpha, alpha_before;
  ConstFaceRef c;
  Real drive_dt;  // f dt [m/s]
  Real density, dt;
  FieldRef b;

  KOKKOS_FORCEINLINE_FUNCTION Real continuity(int i, int j, int k) const {
    if constexpr (!is_variable(fraction)) return div_at_cell(grid, u, i, j, k);
    const auto x = [&](int ii) {
      return cell_to_xface(alpha, ii, j, k) * u.x(ii, j, k) + drive_dt * c.x(ii, j, k);
    };
    const auto y = [&](int jj) { return cell_to_yface(grid, alpha, i, jj, k) * u.y(i, jj, k); };
    const auto z = [&](int kk) { return cell_to_zface(alpha, i, j, kk) * u.z(i, j, kk); };
    return (x(i + 1) - x(i)) * (1 / grid.dx) + (y(j + 1) - y(j)) * (1 / grid.dy(j)) +
           (z(k + 1) - z(k)) * (1 / grid.dz) + (alpha(i, j, k) - alpha_before(i, j, k)) * (1 / dt);
  }
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    b(i, j, k) = -(density / dt) * continuity(i, j, k);
  }
};

/// |div(alpha u) + d(alpha)/dt| dt: what a step leaves of the continuity equation [-].
template <Fraction fraction>
struct ContinuityResidual {
  PressureSource<fraction> source;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return Kokkos::abs(source.continuity(i, j, k)) * source.dt;
  }
};

/// u_z += f_z dt: the drive across, where it acts.
struct DriveAcross {
  FieldRef u_z;
  Real drive_dt;  // [m/s]
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    u_z(i, j, k) += drive_dt;
  }
};

/// u = u* + (c / alpha) (f dt e_x - (dt / rho) grad p). Keeps the change of the old velocity as
/// du_dt. Walls stay at rest. The mobility c is alpha but on faces of bodies.
template <Fraction fraction>
struct CorrectVelocity {
  GridRef grid;
  ConstFaceRef u_star;
  ConstFieldRef p;      // with ghosts
  ConstFieldRef alpha;  // with ghosts; not read where the fraction is uniform, nor is c
  ConstFaceRef c;
  Real inv_density;  // 1 / rho
  Real drive_dt, dt;
  FaceRef u, du_dt;

  /// Returns the Courant number of the new velocity, and alpha u dy and alpha w dy on faces
  /// [m^2/s].
  KOKKOS_FORCEINLINE_FUNCTION LargestAndSums operator()(int i, int j, int k) const {
    const Real inside = j > 0 ? Real(1) : Real(0);
    const Real push = dt * inv_density;
    Real push_x = drive_dt - push * ddx_at_xface(grid, p, i, j, k);
    Real push_y = push * ddy_at_yface(grid, p, i, j, k);
    Real push_z = push * ddz_at_zface(grid, p, i, j, k);
    if constexpr (is_variable(fraction)) {
      push_x *= c.x(i, j, k) / cell_to_xface(alpha, i, j, k);
      push_y *= c.y(i, j, k) / cell_to_yface(grid, alpha, i, j, k);
      push_z *= c.z(i, j, k) / cell_to_zface(alpha, i, j, k);
    }
    const Real ux = u_star.x(i, j, k) + push_x;
    const Real uy = inside * (u_star.y(i, j, k) - push_y);
    const Real uz = u_star.z(i, j, k) - push_z;
    du_dt.x(i, j, k) = (ux - u.x(i, j, k)) * (1 / dt);
    du_dt.y(i, j, k) = (uy - u.y(i, j, k)) * (1 / dt);
    du_dt.z(i, j, k) = (uz - u.z(i, j, k)) * (1 / dt);
    u.x(i, j, k) = ux;
    u.y(i, j, k) = uy;
    u.z(i, j, k) = uz;
    Real flow_x = ux * grid.dy(j), flow_z = uz * grid.dy(j);
    if constexpr (is_variable(fraction)) {
      flow_x *= cell_to_xface(alpha, i, j, k);
      flow_z *= cell_to_zface(alpha, i, j, k);
    }
    return {courant_number({ux, uy, uz}, {grid.dx, grid.dy_centre(j), grid.dz}, dt),
            {flow_x, flow_z}};
  }
};

}  // namespace barchan
