// Interpolation from cell centres as OpenFOAM's "cellPointFace" does it, for comparison with CFDEM:
// linear in the tetrahedron that holds the point, of the centre of its cell, the middle of a face
// and the two ends of an edge of this face. Values on faces are linear between the two cells, those
// at the corners of cells are means of the eight cells around with the inverse of their distance.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// Position of a point in its cell: the tetrahedron, and the weights of its four corners.
struct CellPointFace {
  int cell[3];      // the cell along x, y, z
  int axis[3];      // axis of the face, from its middle to the edge, along the edge
  int side[3];      // 0 or 1: lower or upper side of the cell, of the face and the edge
  Real face, edge;  // share of the way from the centre to the face, from there to the edge
  Real upper;       // share of the way along the edge

  KOKKOS_INLINE_FUNCTION CellPointFace(const GridRef& grid, const PeriodicBox& box,
                                       const Vec3& point) {
    const Vec3 p = box.wrap(point);
    cell[0] = Kokkos::clamp(GridRef::cell_along(p.x, grid.dx) - grid.i_begin, 0, grid.nx - 1);
    cell[1] = grid.row_of(p.y);
    cell[2] = Kokkos::clamp(GridRef::cell_along(p.z, grid.dz) - grid.k_begin, 0, grid.nz - 1);
    // Distance from the centre of the cell, in halves of its width.
    const Real place[3] = {from_centre(p.x, grid.x_centre(cell[0]), grid.dx),
                           from_centre(p.y, grid.y_centre(cell[1]), grid.dy(cell[1])),
                           from_centre(p.z, grid.z_centre(cell[2]), grid.dz)};
    const auto length = [&](int a) { return Kokkos::abs(place[a]); };
    axis[0] = length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2)
                                     : (length(1) >= length(2) ? 1 : 2);
    const int b = (axis[0] + 1) % 3, c = (axis[0] + 2) % 3;
    axis[1] = length(b) >= length(c) ? b : c;
    axis[2] = length(b) >= length(c) ? c : b;
    for (int a = 0; a < 3; ++a) side[a] = place[axis[a]] > 0;
    face = length(axis[0]);
    edge = face > 0 ? length(axis[1]) / face : 0;
    upper = length(axis[1]) > 0 ? (1 + place[axis[2]] / length(axis[1])) / 2 : Real(0.5);
  }

  /// Value of a field with its ghosts.
  KOKKOS_INLINE_FUNCTION Real operator()(const GridRef& grid, const ConstFieldRef& f) const {
    const Real on_edge = (1 - upper) * corner(grid, f, 0) + upper * corner(grid, f, 1);
    const Real on_face = (1 - edge) * middle_of_face(grid, f) + edge * on_edge;
    return (1 - face) * f(cell[0], cell[1], cell[2]) + face * on_face;
  }

 private:
  KOKKOS_INLINE_FUNCTION static Real from_centre(Real x, Real centre, Real width) {
    return Kokkos::clamp(2 * (x - centre) / width, Real(-1), Real(1));
  }

  KOKKOS_INLINE_FUNCTION Real middle_of_face(const GridRef& grid, const ConstFieldRef& f) const {
    int n[3] = {cell[0], cell[1], cell[2]};
    n[axis[0]] += side[0] ? 1 : -1;
    const Real own = f(cell[0], cell[1], cell[2]), other = f(n[0], n[1], n[2]);
    Real share = 0.5;  // share of the cell beyond
    if (axis[0] == 1) share = grid.dy(cell[1]) / (grid.dy(cell[1]) + grid.dy(n[1]));
    return (1 - share) * own + share * other;
  }

  /// Value at the lower (0) or upper (1) end of the edge.
  KOKKOS_INLINE_FUNCTION Real corner(const GridRef& grid, const ConstFieldRef& f, int end) const {
    int p[3] = {cell[0], cell[1], cell[2]};
    p[axis[0]] += side[0], p[axis[1]] += side[1], p[axis[2]] += end;
    Real sum = 0, weights = 0;
    for (int j = p[1] - 1; j <= p[1]; ++j) {
      const Real across = grid.dx * grid.dx / 4 + grid.dz * grid.dz / 4, up = grid.dy(j) / 2;
      const Real w = 1 / Kokkos::sqrt(across + up * up);
      weights += 4 * w;
      sum += w * (f(p[0] - 1, j, p[2] - 1) + f(p[0], j, p[2] - 1) + f(p[0] - 1, j, p[2]) +
                  f(p[0], j, p[2]));
    }
    return sum / weights;
  }
};

}  // namespace barchan
