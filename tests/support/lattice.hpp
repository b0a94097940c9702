// Equal grains on a simple cubic lattice whose spacing fits the cells: every cell then holds the
// same solid volume wherever the lattice has moved to.
#pragma once

#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"

namespace barchan::test {

/// Spacing of a simple cubic lattice of solid fraction s [m].
inline double cubic_spacing(double solid_fraction, double d) {
  return std::cbrt(volume_of(d) / solid_fraction);
}

/// n[0] x n[1] x n[2] grains from `corner` on. Overlaps are allowed: frozen grains do not notice.
inline InitialGrains cubic_lattice(std::array<int, 3> n, double spacing, double d,
                                   const Vec3& corner = {}) {
  InitialGrains grains;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        test::add_grain(grains, d, corner + spacing * Vec3{i + 0.5, j + 0.5, k + 0.5});
      }
  return grains;
}

}  // namespace barchan::test
