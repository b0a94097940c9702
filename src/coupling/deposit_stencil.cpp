#include "src/coupling/deposit_stencil.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/errors.hpp"
#include "src/parallel/decomposition.hpp"

namespace barchan {

namespace {

/// Sets the ends of one direction. Points beyond the end of a pencil lie in its ghosts; beyond an
/// end of the domain they wrap by `length`, or without a period belong to the last cell.
void set_ends(const RankAxis& line, bool periodic, int n, Real& length, int& low, int& high) {
  if (!periodic || line.count > 1) length = 0;
  if (line.count == 1) return;
  if (periodic || line.position > 0) low = -1;
  if (periodic || line.position + 1 < line.count) high = n;
}

}  // namespace

DepositStencil make_deposit_stencil(const CoupledCase& config, const Grid& grid, Real r_max,
                                    PointModel points) {
  const bool periodic_x = is_periodic_x(config.grains->grains);
  const bool periodic_z = config.grains->grains.boundary_z == GrainBoundaryZ::periodic;
  DepositStencil stencil = deposit_stencil_in(grid, points, periodic_x);
  const RankAxis along_x = grid.ranks ? grid.ranks->along_x() : RankAxis{};
  const RankAxis along_z = grid.ranks ? grid.ranks->along_z() : RankAxis{};
  set_ends(along_x, periodic_x, grid.nx, stencil.box.lx, stencil.i_low, stencil.i_high);
  set_ends(along_z, periodic_z, grid.nz, stencil.box.lz, stencil.k_low, stencil.k_high);
  const Real reach = kOuterShell * r_max;
  if (grid.ranks && reach > std::min(grid.dx, grid.dz)) {
    throw ConfigError({fmt::format(
        "--ranks: cells of {:.3g} x {:.3g} m are smaller than the radius of the largest grain, "
        "{:.3g} m: start this case with --ranks 1, or with wider cells (fluid.cells)",
        grid.dx, grid.dz, r_max)});
  }
  return stencil;
}

}  // namespace barchan
