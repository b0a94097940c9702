// Which cells a grain's volume may go to: where directions are periodic, end at walls or are cut.
#pragma once

#include "kernels/coupling/void_fraction.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// The cells that grains up to a radius of r_max [m] deposit their volume in. Where the grid is
/// cut, points of a grain may lie in ghosts; throws ConfigError if it could reach beyond.
DepositStencil make_deposit_stencil(const CoupledCase& config, const Grid& grid, Real r_max,
                                    PointModel points);

}  // namespace barchan
