// The cells that a grain's volume is deposited in, by the configuration and the cuts of the grid.
#include <fmt/format.h>

#include <algorithm>

#include "src/config/load.hpp"
#include "src/coupling/coupling.hpp"

namespace barchan {

namespace {

PointSet point_set(VoidFraction v) {
  switch (v) {
    case VoidFraction::centre:
      return PointSet::centre;
    case VoidFraction::cfdem_faithful:
      return PointSet::cfdem;
    case VoidFraction::divided:
      break;
  }
  return PointSet::divided;
}

}  // namespace

DepositStencil make_deposit_stencil(const Config& config, const Grid& grid, Real r_max) {
  const bool periodic_x = config.grains->boundary_x == GrainBoundaryX::periodic;
  DepositStencil stencil =
      deposit_stencil_in(grid, point_set(config.coupling.void_fraction), periodic_x);
  if (!grid.ranks) return stencil;
  const Real reach = kOuterShell * r_max;
  if (reach > std::min(grid.dx, grid.dz)) {
    throw ConfigError({fmt::format(
        "--ranks: cells of {:.3g} x {:.3g} m are smaller than the radius of the largest grain, "
        "{:.3g} m: start this case with --ranks 1, or with wider cells (fluid.cells)",
        grid.dx, grid.dz, r_max)});
  }
  const RankLine &along_x = grid.ranks->along_x(), &along_z = grid.ranks->along_z();
  if (along_x.count > 1) {
    stencil.box.lx = 0;
    if (periodic_x || along_x.position > 0) stencil.i_low = -1;
    if (periodic_x || along_x.position + 1 < along_x.count) stencil.i_high = grid.nx;
  }
  if (along_z.count > 1) {
    stencil.box.lz = 0;
    stencil.k_low = -1, stencil.k_high = grid.nz;
  }
  return stencil;
}

}  // namespace barchan
