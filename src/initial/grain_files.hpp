// Grains from result and restart files, and from tables.
#pragma once

#include <filesystem>

#include "src/grains/initial_grains.hpp"

namespace barchan {

/// By the ending: .csv, or .h5, which is a grains.h5 (its last frame) or a restart file (arrays
/// grains/id and grains/kin). Throws std::runtime_error with a sentence for the user.
InitialGrains read_grains(const std::filesystem::path& file);

}  // namespace barchan
