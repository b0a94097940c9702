// Drag between layers: grains that lie in several rows of cells drag these along with each other.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// Changes of velocity within a step drag neighbouring rows along, too. In each column (i, k) of
/// faces of u or w, with the change e* = u* - u that the predictor has made and the change e that
/// is left of it, per area of floor:
///   m_j (e_j - e*_j) = C_j (e_{j-1} - e_j) - C_{j+1} (e_j - e_{j+1}),   m_j = rho alpha dy_j,
/// C_j the interlayer drag between rows j - 1 and j. Implicit, so stable at any step; no momentum
/// is lost. The drag at the old velocities is in u* already (docs/theory-coupling.md).
struct InterlayerDrag {
  GridRef grid;
  int rows = 0;                   // those above have no interlayer drag
  ConstFieldRef interlayer_drag;  // C_j / dy_j on these faces [kg/m^3]
  ConstFieldRef alpha;            // with ghosts
  ConstFieldRef u;                // before the step [m/s]
  Real density = 0;               // rho
  bool along_x = true;            // faces of u, or of w
  FieldRef u_star, pivot;         // predicted velocity; room of the solver

  /// C_j [kg/m^2]
  KOKKOS_FORCEINLINE_FUNCTION Real coupling(int i, int j, int k) const {
    return interlayer_drag(i, j, k) * grid.dy(j);
  }

  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    int top = rows;
    while (top > 1 && coupling(i, top - 1, k) == 0) --top;
    if (top <= 1) return;
    Real below = 0, e_below = 0, pivot_below = 0;
    for (int j = 0; j < top; ++j) {
      const Real above = j + 1 < top ? coupling(i, j + 1, k) : 0;
      const Real on_face = along_x ? cell_to_xface(alpha, i, j, k) : cell_to_zface(alpha, i, j, k);
      const Real mass = density * on_face * grid.dy(j);
      pivot_below = 1 / (mass + below + above - below * below * pivot_below);
      e_below = pivot_below * (mass * (u_star(i, j, k) - u(i, j, k)) + below * e_below);
      pivot(i, j, k) = pivot_below;
      u_star(i, j, k) = u(i, j, k) + e_below;
      below = above;
    }
    for (int j = top - 2; j >= 0; --j) {
      const Real e_above = u_star(i, j + 1, k) - u(i, j + 1, k);
      u_star(i, j, k) += pivot(i, j, k) * coupling(i, j + 1, k) * e_above;
    }
  }
};

}  // namespace barchan
