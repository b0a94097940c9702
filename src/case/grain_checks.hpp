// Checks of [grains]: between its keys, and against the cells, the flow and the sizes of the
// grains.
#pragma once

#include <vector>

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks [grains] and its cone against each other and against the fluid. `config` has the section.
void check_grains(const Config& config, Findings& found);

/// Checks that depend on the sizes alone: the grain step against the Rayleigh time, cells against
/// grains.
std::vector<Finding> check_grain_sizes(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
