// Keys that were changed and can do nothing in the case at hand.
#pragma once

#include <string_view>

#include "src/config/config.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// Keys that were changed and can do nothing.
void check_effects(const Config& config, Findings& found);

/// The key or section by which a key, which must be there, can do nothing in this case, whatever
/// its value; empty: it can.
std::string_view switched_off_by(const std::string& dotted, const Config& config);

}  // namespace barchan
