// The grid of a run.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "src/fluid/fluid_case.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// nx x nz uniform cells over lx x lz [m], rows between the given ny + 1 faces [m], which increase.
/// The corner is at the origin. With `ranks`, the part of this one.
Grid make_grid(int nx, int nz, Real lx, Real lz, const std::vector<double>& y_faces,
               const Decomposition* ranks = nullptr);

/// The grid of [domain] and [fluid]; `config.fluid` must be there.
Grid make_grid(const FluidCase& config, const Decomposition* ranks = nullptr);

/// Pencils of the grid among the ranks; null for one rank, or without fluid. All ranks together.
/// Throws ConfigError if there are too many ranks.
std::unique_ptr<const Decomposition> make_decomposition(const std::optional<FluidConfig>& fluid,
                                                        MPI_Comm communicator);

}  // namespace barchan
