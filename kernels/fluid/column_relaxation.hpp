// Relaxation of the pressure equation in the columns that hold grains.
#pragma once

#include "kernels/fluid/pressure.hpp"

namespace barchan {

/// Rows [0, height) of each column (i, k) take part in the relaxation; 0: none do. Kept as a field
/// of one row, so that the columns of other ranks come as ghosts.
struct ColumnHeights {
  FieldRef height;
  KOKKOS_FORCEINLINE_FUNCTION int operator()(int i, int k) const {
    return static_cast<int>(height(i, 0, k));
  }
  KOKKOS_FORCEINLINE_FUNCTION void set(int i, int k, int rows) const { height(i, 0, k) = rows; }
};

/// Neighbours and colours of the columns of one rank. Along a direction that it has to itself the
/// neighbour across the seam is its own last column; otherwise ghosts hold it.
struct ColumnNeighbors : GridExtents {
  KOKKOS_FORCEINLINE_FUNCTION int left(int i) const {
    return i == 0 && nx == nx_all ? nx - 1 : i - 1;
  }
  KOKKOS_FORCEINLINE_FUNCTION int right(int i) const { return i == nx_all - 1 ? 0 : i + 1; }
  KOKKOS_FORCEINLINE_FUNCTION int back(int k) const {
    return k == 0 && nz == nz_all ? nz - 1 : k - 1;
  }
  KOKKOS_FORCEINLINE_FUNCTION int front(int k) const { return k == nz_all - 1 ? 0 : k + 1; }

  /// Neighbouring columns never share a colour, not even across an odd periodic seam.
  KOKKOS_FORCEINLINE_FUNCTION int colours() const {
    return nx_all % 2 == 0 && nz_all % 2 == 0 ? 2 : 3;
  }
  KOKKOS_FORCEINLINE_FUNCTION int colour(int i, int k) const {
    return (part(i + i_begin, nx_all) + part(k + k_begin, nz_all)) % colours();
  }
  KOKKOS_FORCEINLINE_FUNCTION static int part(int index, int n) {
    return index == n - 1 && n % 2 == 1 ? 2 : index % 2;
  }
};

/// Height of a column up to its highest cell with a face where c is below `threshold`.
struct FindColumns {
  ConstFaceRef c;  // with periodic ghosts
  int ny;
  Real threshold;
  ColumnHeights height;

  /// Smallest c on the faces around a cell's sides.
  KOKKOS_FORCEINLINE_FUNCTION Real sides(int i, int j, int k) const {
    const Real x = Kokkos::min(c.x(i, j, k), c.x(i + 1, j, k));
    return Kokkos::min(x, Kokkos::min(c.z(i, j, k), c.z(i, j, k + 1)));
  }
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    // On the wall c is zero for another reason; a face between two rows counts for the upper one.
    int top = sides(i, 0, k) < threshold ? 1 : 0;
    for (int j = 1; j < ny; ++j) {
      const Real least = Kokkos::min(c.y(i, j, k), sides(i, j, k));
      top = least < threshold ? j + 1 : top;
    }
    height.set(i, k, top);
  }
};

/// One more layer all around: a column reaches one row above itself and its neighbours.
struct WidenColumns {
  int ny;
  ColumnHeights before, after;  // the former with ghosts
  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    const int left = before(i - 1, k), right = before(i + 1, k);
    const int back = before(i, k - 1), front = before(i, k + 1);
    const int around = Kokkos::max(Kokkos::max(left, right), Kokkos::max(back, front));
    const int highest = Kokkos::max(around, before(i, k) + (before(i, k) > 0 ? 1 : 0));
    after.set(i, k, Kokkos::min(highest, ny));
  }
};

/// The tridiagonal equations of a column, height-weighted so that they are symmetric:
///   D_j z_j - E_j z_{j-1} - E_{j+1} z_{j+1} = dy_j (r_j + what the neighbours' z add).
struct ColumnEquations {
  GridRef grid;
  ConstFaceRef c;

  KOKKOS_FORCEINLINE_FUNCTION Real coupling(int i, int j, int k) const {  // E_j [1/m]
    return c.y(i, j, k) / grid.dy_centre(j);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real diagonal(int i, int j, int k) const {  // D_j [1/m]
    return grid.dy(j) * pressure_diagonal(grid, c, i, j, k);
  }
};

/// 1/(D_j - E_j^2 pivot_{j-1}) of every row of a column; 0 for a cell whose faces are all closed.
struct FactoriseColumn {
  ColumnEquations equations;
  ColumnHeights height;
  FieldRef pivot;
  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    Real before = 0;
    for (int j = 0; j < height(i, k); ++j) {
      const Real e = equations.coupling(i, j, k);
      const Real diagonal = equations.diagonal(i, j, k);
      before = diagonal > 0 ? 1 / (diagonal - e * e * before) : 0;
      pivot(i, j, k) = before;
    }
  }
};

/// Solves the columns of one colour for z with all other columns, and the cells above, as they are,
/// and goes `over` times as far: a step of block SOR, whose result does not depend on the order
/// within a colour. With 0 < over < 2 sweeps there and back are symmetric and positive definite.
struct RelaxColumns {
  ColumnEquations equations;
  ColumnHeights height;
  ConstFieldRef pivot, r;
  FieldRef z;
  Real* workspace;  // a number of each cell
  Real over;
  int colour;

  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    const GridRef& grid = equations.grid;
    const int rows = height(i, k);
    if (rows == 0) return;
    const ColumnNeighbors neighbors{grid};
    if (neighbors.colour(i, k) != colour) return;
    const ConstFaceRef& c = equations.c;
    const int left = neighbors.left(i), right = neighbors.right(i);
    const int back = neighbors.back(k), front = neighbors.front(k);
    const Real per_dx2 = 1 / (grid.dx * grid.dx), per_dz2 = 1 / (grid.dz * grid.dz);
    Real* const solved = workspace + std::ptrdiff_t{grid.ny} * (i + std::ptrdiff_t{grid.nx} * k);
    Real below = 0;  // pivot * eliminated right-hand side of the row below
    for (int j = 0; j < rows; ++j) {
      const Real x = c.x(i, j, k) * z(left, j, k) + c.x(i + 1, j, k) * z(right, j, k);
      const Real across = c.z(i, j, k) * z(i, j, back) + c.z(i, j, k + 1) * z(i, j, front);
      Real g = grid.dy(j) * (r(i, j, k) + x * per_dx2 + across * per_dz2);
      if (j == rows - 1 && rows < grid.ny) g += equations.coupling(i, rows, k) * z(i, rows, k);
      below = pivot(i, j, k) * (g + equations.coupling(i, j, k) * below);
      solved[j] = below;
    }
    Real above = 0;
    for (int j = rows - 1; j >= 0; --j) {
      const Real coupling = j + 1 < rows ? equations.coupling(i, j + 1, k) : 0;
      above = solved[j] + pivot(i, j, k) * coupling * above;
      z(i, j, k) += over * (above - z(i, j, k));
    }
  }
};

/// Before the global solve: r becomes r - A z in the columns and around them, after a copy.
struct SubtractLocal {
  GridRef grid;
  ConstFaceRef c;
  ColumnHeights height;  // with one layer more than z has
  ConstFieldRef z;
  FieldRef r, copy;
  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    for (int j = 0; j < height(i, k); ++j) {
      copy(i, j, k) = r(i, j, k);
      r(i, j, k) -= pressure_operator(grid, c, z, i, j, k);
    }
  }
};
/// After it: r as before, and the local z added to the global one and cleared.
struct AddLocal {
  ColumnHeights height;  // the same
  ConstFieldRef copy;
  FieldRef local, r, z;
  KOKKOS_FUNCTION void operator()(int i, int, int k) const {
    for (int j = 0; j < height(i, k); ++j) {
      r(i, j, k) = copy(i, j, k);
      z(i, j, k) += local(i, j, k);
      local(i, j, k) = 0;
    }
  }
};

}  // namespace barchan
