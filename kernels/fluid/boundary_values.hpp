// Ghost values at the walls y = 0 and y = Ly.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// What the ghost row behind a wall holds.
enum class GhostRule {
  same,      // the row inside: zero gradient on the wall
  opposite,  // its negative plus twice the wall's value: that value on the wall
  wall_face  // the field lives on y-faces: zero on the wall itself, mirrored negative behind it
};

/// Fills the ghosts behind both walls of columns (i, k).
struct FillWallGhosts {
  FieldRef f;
  int ny;
  GhostRule bottom, top;
  Real top_value = 0;  // of the field on the upper wall, for GhostRule::opposite

  KOKKOS_FORCEINLINE_FUNCTION static Real ghost(GhostRule rule, Real inside, Real wall) {
    return rule == GhostRule::same ? inside : 2 * wall - inside;
  }
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    if (bottom == GhostRule::wall_face) {
      f(i, -1, k) = ny > 1 ? -f(i, 1, k) : 0;
      f(i, 0, k) = 0;
      f(i, ny, k) = 0;
    } else {
      f(i, -1, k) = ghost(bottom, f(i, 0, k), 0);
      f(i, ny, k) = ghost(top, f(i, ny - 1, k), top_value);
    }
  }
};

}  // namespace barchan
