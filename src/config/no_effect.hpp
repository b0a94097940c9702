// Keys that were changed and can do nothing in the case at hand.
#pragma once

#include "src/config/config.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// Keys that were changed and can do nothing.
void check_effects(const Config& config, Findings& found);

/// False if a key could do nothing in this case, whatever its value.
bool has_effect(const std::string& dotted, const Config& config);

}  // namespace barchan
