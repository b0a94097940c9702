// Ghost values of a field: behind the walls y = 0 and y = Ly, and across the periodic sides.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Content of the ghost row behind a wall.
enum class GhostRule {
  as_it_is,  // whatever it holds
  same,      // the row inside: zero gradient on the wall
  opposite,  // its negative plus twice the wall's value: that value on the wall
  wall_face  // the field lives on y-faces: zero on the wall itself, mirrored negative behind it
};

/// Both walls.
struct WallRules {
  GhostRule bottom = GhostRule::as_it_is, top = GhostRule::as_it_is;
  Real top_value = 0;  // of the field on the upper wall, for GhostRule::opposite
};

/// A field and the rules of its walls.
struct FieldWithWalls {
  FieldRef f;
  int ny = 0;
  WallRules walls;

  /// Value of row j, of the ghosts -1 and ny by the rules, from cells inside alone.
  KOKKOS_FORCEINLINE_FUNCTION Real value(int i, int j, int k) const {
    if (j == -1) return behind(walls.bottom, i, -1, 0, k, 0);
    if (j == ny) return behind(walls.top, i, ny, ny - 1, k, walls.top_value);
    return j == 0 && walls.bottom == GhostRule::wall_face ? 0 : f(i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION bool has_rules() const { return walls.bottom != GhostRule::as_it_is; }
  KOKKOS_FORCEINLINE_FUNCTION void fill_walls(int i, int k) const {
    f(i, -1, k) = value(i, -1, k);
    f(i, ny, k) = value(i, ny, k);
    if (walls.bottom == GhostRule::wall_face) f(i, 0, k) = 0;
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION Real behind(GhostRule rule, int i, int ghost, int inside, int k,
                                          Real on_wall) const {
    if (rule == GhostRule::as_it_is) return f(i, ghost, k);
    if (rule == GhostRule::same) return f(i, inside, k);
    if (rule == GhostRule::opposite) return 2 * on_wall - f(i, inside, k);
    return ghost == ny || ny == 1 ? 0 : -f(i, 1, k);
  }
};

/// Fills the ghosts behind both walls of columns (i, k).
struct FillWalls {
  FieldWithWalls field;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const { field.fill_walls(i, k); }
};
/// Fills the ghost rows behind both walls of some fields.
template <std::size_t n>
struct FillWallsOf {
  Kokkos::Array<FieldWithWalls, n> fields;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    for (std::size_t f = 0; f < n; ++f) fields[f].fill_walls(i, k);
  }
};

/// Fills all ghosts of some fields, corners included, where x and z are not cut among ranks. Cells
/// inside alone are read, so one launch does it.
struct FillGhosts {
  int n = 0, nx = 0, ny = 0, nz = 0;
  FieldWithWalls field[3];

  /// Lines of ghosts of a field: in each plane k those behind the walls and those beyond the ends
  /// of x; in each row j those beyond the ends of z.
  KOKKOS_FORCEINLINE_FUNCTION int lines() const { return 2 * nz + ny + 2; }
  KOKKOS_FORCEINLINE_FUNCTION int longest() const { return (nx > ny ? nx : ny) + 2; }

  /// Ghosts [begin, end) of a line, counted from -1.
  KOKKOS_INLINE_FUNCTION void operator()(int line, int begin, int end) const {
    const FieldWithWalls& of = field[line / lines()];
    const int at = line % lines();
    if (at < nz) {
      if (of.has_rules()) behind_walls(of, at, Kokkos::max(begin, 0), Kokkos::min(end, nx));
    } else if (at < 2 * nz) {
      beyond_x(of, at - nz, begin, Kokkos::min(end, ny + 1));
    } else {
      beyond_z(of, at - 2 * nz - 1, begin, Kokkos::min(end, nx + 1));
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void behind_walls(const FieldWithWalls& of, int k, int begin,
                                                int end) const {
#pragma omp simd
    for (int i = begin; i < end; ++i) of.fill_walls(i, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION void beyond_x(const FieldWithWalls& of, int k, int begin,
                                            int end) const {
    for (int j = begin; j < end; ++j) {
      of.f(-1, j, k) = of.value(nx - 1, j, k);
      of.f(nx, j, k) = of.value(0, j, k);
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION void beyond_z(const FieldWithWalls& of, int j, int begin,
                                            int end) const {
#pragma omp simd
    for (int i = begin; i < end; ++i) {
      const int inside = i < 0 ? nx - 1 : i == nx ? 0 : i;
      of.f(i, j, -1) = of.value(inside, j, nz - 1);
      of.f(i, j, nz) = of.value(inside, j, 0);
    }
  }
};

}  // namespace barchan
