// Force of the flow's pressure gradient and stress on a volume of solid, on faces and in cells.
// Equations: docs/theory-coupling.md, "Pressure and stress".
#pragma once

#include "kernels/fluid/momentum.hpp"

namespace barchan {

/// Force of the pressure gradient on a volume of grain, on faces: -grad p + rho f [N/m^3] (Lima
/// et al. 2022, B9).
struct PressureForceDensity {
  GridRef grid;
  ConstFieldRef p;
  Real rho_f = 0;
  Vec2 drive;  // f [m/s^2]
  FaceRef force;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    force.x(i, j, k) = -(ddx_at_xface(grid, p, i, j, k) - rho_f * drive.x);
    force.y(i, j, k) = -ddy_at_yface(grid, p, i, j, k);
    force.z(i, j, k) = -(ddz_at_zface(grid, p, i, j, k) - rho_f * drive.z);
  }
};

/// Force of the stress on a volume of grain, on faces: rho div(2 (nu + nu_t) S) [N/m^3] (B10; Set
/// II: the same stress as in the fluid equation); and the convective acceleration u . grad u
/// [m/s^2] of the added mass.
struct StressForceDensity {
  GridRef grid;
  ConstFaceRef u;
  StressDivergence stress;
  Real rho_f = 0;
  FaceRef force, convective;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    force.x(i, j, k) = rho_f * stress.x(i, j, k);
    force.y(i, j, k) = rho_f * stress.y(i, j, k);
    force.z(i, j, k) = rho_f * stress.z(i, j, k);

    const ConvectiveAcceleration acceleration{grid, u};
    convective.x(i, j, k) = acceleration.x(i, j, k);
    convective.y(i, j, k) = j > 0 ? acceleration.y(i, j, k) : Real(0);
    convective.z(i, j, k) = acceleration.z(i, j, k);
  }
};

/// The force density on the lower wall takes the value of the first face inside.
struct HoldForceAtWall {
  FieldRef force_y;
  int ny;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    force_y(i, 0, k) = force_y(i, ny > 1 ? 1 : 0, k);
  }
};

/// Brings the force density to cells, as the mean of their faces: the adjoint of alpha_f on faces.
/// Returns the part that the solid fraction of a cell takes [N]; summed over all cells, this is
/// what the flow does not get.
struct ForceOnCells {
  GridRef grid;
  ConstFaceRef force;  // with ghosts
  ConstFieldRef alpha_f;
  FieldRef x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    const Vec3 density{(force.x(i, j, k) + force.x(i + 1, j, k)) / 2,
                       (force.y(i, j, k) + force.y(i, j + 1, k)) / 2,
                       (force.z(i, j, k) + force.z(i, j, k + 1)) / 2};
    x(i, j, k) = density.x;
    y(i, j, k) = density.y;
    z(i, j, k) = density.z;
    return ((1 - alpha_f(i, j, k)) * grid.cell_volume(j)) * density;
  }
};

/// Force density of the pressure gradient in a cell, straight from the pressure. Along the floor it
/// is a central difference, which commutes with the smoothing.
struct PressureForceInCell {
  GridRef grid;
  ConstFieldRef p;  // with ghosts in x and z
  Real rho_f = 0;
  Vec2 drive;  // f [m/s^2]

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    return rho_f * drive.x - (p(i + 1, j, k) - p(i - 1, j, k)) * (Real(0.5) / grid.dx);
  }
  /// Vertical force density; a wall takes the value of the first face inside.
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    if (grid.ny == 1) return 0;
    const int below = j > 0 ? j : 1, above = j + 1 < grid.ny ? j + 1 : j;
    return -(ddy_at_yface(grid, p, i, below, k) + ddy_at_yface(grid, p, i, above, k)) / 2;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    return rho_f * drive.z - (p(i, j, k + 1) - p(i, j, k - 1)) * (Real(0.5) / grid.dz);
  }
};

/// Writes the fields to be smoothed: the pressure and the vertical force density. Returns the force
/// that the solid fraction takes [N].
struct PressureToSmooth {
  PressureForceInCell force;
  ConstFieldRef alpha_f;
  FieldRef p, y;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    const Vec3 density{force.x(i, j, k), force.y(i, j, k), force.z(i, j, k)};
    p(i, j, k) = force.p(i, j, k);
    y(i, j, k) = density.y;
    return ((1 - alpha_f(i, j, k)) * force.grid.cell_volume(j)) * density;
  }
};

/// Writes the force density along the floor, from the smoothed pressure.
struct SmoothedPressureForce {
  PressureForceInCell force;
  FieldRef x, z;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    x(i, j, k) = force.x(i, j, k);
    z(i, j, k) = force.z(i, j, k);
  }
};

}  // namespace barchan
