// Discs in a plane that overlap: the union cut into one cell for each of them, exactly.
#pragma once

#include <cstddef>
#include <span>

#include "kernels/math/vec3.hpp"

namespace barchan {

struct Disc {
  Real x = 0, y = 0, radius = 0;
};

/// Integrals of 1, x, y, x^2, x y and y^2 over a part of the plane.
struct PlaneMoments {
  Real area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

/// Cell of disc i: the points in it whose power |p - c_i|^2 - r_i^2 is the smallest of all discs'
/// (power or Laguerre diagram, Aurenhammer, SIAM J. Comput. 16, 78 (1987)). Cells do not overlap
/// and fill the union.
struct DiscCell {
  PlaneMoments moments;
  Real exposed = 0;  // angle of its circle that is on the edge of the union [rad]
};

/// The cell is bounded by arcs and by chords on lines of equal power; sums over both are exact.
DiscCell disc_cell(std::span<const Disc> discs, std::size_t i);

}  // namespace barchan
