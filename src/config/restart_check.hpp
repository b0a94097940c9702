// A restart file against the case that goes on from it.
#pragma once

#include <string>
#include <vector>

#include "src/config/config.hpp"

namespace barchan {

/// What of `written`, the case a restart file comes from, a run of `config` cannot go on with: one
/// sentence for each key. Its numbers would be taken for something else without a further sign.
std::vector<std::string> restart_conflicts(const Config& config, const Config& written);

/// The other keys that differ, as in "grains.sliding_friction 0.6 -> 0.4".
std::vector<std::string> changed_keys(const Config& config, const Config& written);

}  // namespace barchan
