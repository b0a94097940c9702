// Checks of the shapes of grains.
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks that shapes are whole, and that what a case asks for is there for clumps.
void check_shapes(const Config& c, Findings& found);

/// Checks that clumps do not meet their own images. `sizes`: of the grains.
void check_clump_sizes(const Config& c, const std::vector<SizeClass>& sizes, Findings& found);

}  // namespace barchan
