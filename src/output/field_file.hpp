// Fields of the grid in restart files, the same file for any number of ranks.
#pragma once

#include <string>

#include "src/io/checkpoint.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// The cells of all ranks with the ghosts around the whole domain; ghosts of `f` must be valid as
/// far as the next step reads them. All ranks together.
void save_field(CheckpointWriter& file, const std::string& name, const Grid& grid, const Field& f);

/// This rank's part of it, ghosts included.
void load_field(const CheckpointReader& file, const std::string& name, const Grid& grid,
                const Field& f);

}  // namespace barchan
