// Checks of heaps and beds that a case pours.
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks shapes, sizes and places of what is poured, and of hollows in it; `c` has grains.
void check_heaps(const Config& c, Findings& found);

}  // namespace barchan
