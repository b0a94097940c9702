// Measures of how close the state is to an impossible one: overlaps, displacements, Courant number,
// fluid fraction.
#pragma once

#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/body_contact.hpp"
#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {

/// Value itself, or infinity if it is not a number: the worst of all values.
KOKKOS_FORCEINLINE_FUNCTION Real or_infinity(Real value) {
  return value == value ? value : Kokkos::Experimental::infinity_v<Real>;
}

/// Place where something is worst, and the value there.
using WorstItem = Kokkos::MaxLoc<Real, int>::value_type;
KOKKOS_FORCEINLINE_FUNCTION void take_worse(WorstItem& worst, Real value, int at) {
  if (value > worst.val) worst = {value, at};
}

/// Relative overlap of a listed pair [-]. Pairs whose first grain is a ghost are checked on the
/// rank that owns it.
struct PairOverlap {
  PeriodicBox box;
  PairList list;
  Kokkos::View<const GrainKinematics*> grains;
  int n_owned;

  KOKKOS_FUNCTION void operator()(int p, WorstItem& worst) const {
    if (list.i(p) >= n_owned) return;
    const Real overlap = relative_overlap(box, grains(list.i(p)), grains(list.j(p)));
    take_worse(worst, or_infinity(overlap), p);
  }
};

/// Worst grain by overlap with walls and bodies, and by displacement.
struct WorstGrains {
  WorstItem in_wall{0, -1}, displacement{0, -1};
};

/// Limits of a grain: its overlap with walls and bodies over its diameter, and its displacement in
/// a grain step over its radius [-]; infinite where its position or velocity is not finite.
struct GrainLimits {
  Kokkos::View<const GrainKinematics*> grains;
  WallShapes walls;
  Bodies bodies;
  Real dt;  // grain step [s]

  KOKKOS_FUNCTION void operator()(int g, WorstGrains& worst) const {
    const GrainKinematics& grain = grains(g);
    Real overlap = 0;
    for (int w = 0; w < walls.n; ++w) {
      const Real depth = walls.at(w, grain.x).overlap(grain);
      overlap = Kokkos::max(overlap, or_infinity(depth / (2 * grain.r)));
    }
    overlap = Kokkos::max(overlap, deepest_in(bodies, grain.x, grain.r) / (2 * grain.r));
    take_worse(worst.in_wall, overlap, g);
    const Real speed = norm(grain.u) + grain.r * norm(grain.omega);
    // zero if finite, else not a number
    const Real finite = 0 * (grain.x.x + grain.x.y + grain.x.z);
    take_worse(worst.displacement, or_infinity(dt * speed / grain.r + finite), g);
  }
  KOKKOS_FUNCTION static void join(WorstGrains& all, const WorstGrains& more) {
    take_worse(all.in_wall, more.in_wall.val, more.in_wall.loc);
    take_worse(all.displacement, more.displacement.val, more.displacement.loc);
  }
};

/// Courant number of a cell with the velocities of its lower faces [-].
struct CourantOfCell {
  GridRef grid;
  ConstFaceRef u;
  Real dt;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return courant_number({u.x(i, j, k), u.y(i, j, k), u.z(i, j, k)},
                          {grid.dx, grid.dy_centre(j), grid.dz}, dt);
  }
};

/// Distance of the fluid fraction from (0, 1] [-]; negative or zero inside.
struct FractionOutside {
  ConstFieldRef alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real a = alpha(i, j, k);
    return a > 0 ? a - 1 : 1 - a;
  }
};

/// Reduces a functor of cells to the worst cell, by its number.
template <class Functor>
struct WorstCell {
  Functor functor;
  int nx, ny;
  KOKKOS_FUNCTION void operator()(int cell, WorstItem& worst) const {
    take_worse(worst, or_infinity(functor(cell % nx, cell / nx % ny, cell / (nx * ny))), cell);
  }
};

}  // namespace barchan
