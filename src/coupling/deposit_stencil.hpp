// The cells that a grain's volume is deposited in, by the configuration and the cuts of the grid.
#pragma once

#include "kernels/coupling/void_fraction.hpp"
#include "src/config/config.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// How grains up to a radius of r_max [m] find their cells. Where the grid is cut, points of a
/// grain may lie in ghosts; throws ConfigError if it could reach beyond.
DepositStencil make_deposit_stencil(const Config& config, const Grid& grid, Real r_max);

}  // namespace barchan
