// Deposit stencil of a pencil: directions that are periodic, end at walls or are cut.
#pragma once

#include "kernels/coupling/void_fraction.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// Makes the stencil for grains up to a radius of r_max [m]. Where the grid is cut, points of a
/// grain may lie in ghosts; throws ConfigError if it could reach beyond.
DepositStencil make_deposit_stencil(const CoupledCase& config, const Grid& grid, Real r_max,
                                    PointModel points);

}  // namespace barchan
