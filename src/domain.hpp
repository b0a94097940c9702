// The grid of a run.
#pragma once

#include <memory>
#include <vector>

#include "kernels/grid.hpp"
#include "src/config.hpp"

namespace barchan {

/// nx x nz uniform cells over lx x lz [m], rows between the given ny + 1 faces [m], which increase.
/// The corner is at the origin. With `ranks`, the part of this one.
Grid make_grid(int nx, int nz, Real lx, Real lz, const std::vector<double>& y_faces,
               std::shared_ptr<const Decomposition> ranks = nullptr);

/// The grid of [domain] and [fluid]; `config.fluid` must be there.
Grid make_grid(const Config& config);

}  // namespace barchan
