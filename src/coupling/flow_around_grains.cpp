// What the grains read: the force density of the flow around them, the velocity on cells.
#include <algorithm>
#include <cmath>

#include "src/coupling/coupling.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

CellRange Coupling::cells_around(const GrainState& grains) const {
  Real x0 = 0, x1 = 0, y1 = 0, z0 = 0, z1 = 0;
  Kokkos::parallel_reduce("coupling: extent of the grains", items(grains.n),
                          ExtentOfGrains{grains.kin}, Kokkos::Min<Real>(x0), Kokkos::Max<Real>(x1),
                          Kokkos::Max<Real>(y1), Kokkos::Min<Real>(z0), Kokkos::Max<Real>(z1));
  // Those of all ranks: a neighbour's grains read from the outermost cells of this one.
  x0 = -max_over(ranks_of(grid_), -x0), x1 = max_over(ranks_of(grid_), x1);
  z0 = -max_over(ranks_of(grid_), -z0), z1 = max_over(ranks_of(grid_), z1);
  y1 = max_over(ranks_of(grid_), y1);
  CellRange cells = owned_cells(grid_);
  if (!(x0 <= x1)) return cells;  // no grains
  // One more on either side for the interpolation; everything where that reaches a periodic side.
  const auto shrink = [](Real low, Real high, Real spacing, int n_all, int mine, int& first,
                         int& last) {
    const Real begin = std::floor(low / spacing) - 1, end = std::floor(high / spacing) + 2;
    if (!(begin >= 0 && end <= n_all)) return;
    const int n = last;
    first = std::clamp(static_cast<int>(begin) - mine, 0, n);
    last = std::clamp(static_cast<int>(end) - mine, first, n);
  };
  shrink(x0, x1, grid_.dx, grid_.nx_all, grid_.i_begin, cells.i0, cells.i1);
  shrink(z0, z1, grid_.dz, grid_.nz_all, grid_.k_begin, cells.k0, cells.k1);
  cells.j1 = std::min(grid_.ny, rows_.row_of(y1) + 2);
  return cells;
}

void Coupling::force_density(const FluidState& fluid, const GrainState& grains,
                             const FluidForces& forces) {
  const CellRange cells = cells_around(grains);
  for_each_cell("coupling: force density", cells,
                FluidForceDensity{.grid = grid_,
                                  .u = fluid.u,
                                  .p = fluid.p,
                                  .stress = {grid_, fluid.u, fluid.nu_t, nu_},
                                  .rho_f = rho_f_,
                                  .drive = fluid.drive,
                                  .forces = forces,
                                  .force = force_,
                                  .convective = convective_});
  for_each_cell("coupling: force density at the walls",
                CellRange{cells.i0, cells.i1, 0, 1, cells.k0, cells.k1},
                HoldForceAtWall{force_.y, grid_.ny});
  // Behind both walls constant, too.
  for (FaceVector* f : {&force_, &convective_}) {
    for (Field* component : {&f->x, &f->y, &f->z}) boundary_.fill(*component, FieldKind::scalar);
  }
}

ReadingFromCells Coupling::velocity_on_cells(const FluidState& fluid) {
  if (config_.void_fraction != VoidFraction::cfdem_faithful) return {};
  Field &x = cell_[1], &y = cell_[2], &z = cell_[3];
  for_each_cell("coupling: velocity on cells", grid_,
                VelocityOnCells{.u = fluid.u, .x = x, .y = y, .z = z});
  boundary_.fill(x, FieldKind::velocity_x);
  for (Field* component : {&y, &z}) boundary_.fill(*component, FieldKind::velocity_z);
  return {.on = true, .x = x, .y = y, .z = z};
}

}  // namespace barchan
