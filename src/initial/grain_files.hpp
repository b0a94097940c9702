// Grains from result and restart files, and from tables.
#pragma once

#include <filesystem>

#include "src/case/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Reads grains, by the ending of the file: .csv, or .h5, which is a grains.h5 (its last frame) or
/// a restart file (arrays grains/id and grains/kin). Throws std::runtime_error with a sentence for
/// the user.
InitialGrains read_grains(const std::filesystem::path& file);

/// Wraps grains that left through a periodic side since the last list rebuild; one that would have
/// to move by more than the domain stays. The case has [grains].
void wrap(InitialGrains& grains, const Config& config);

}  // namespace barchan
