// Keys that were changed and can do nothing in the case at hand.
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Reports keys that were changed and can do nothing.
void check_effects(const Config& config, Findings& found);

}  // namespace barchan
