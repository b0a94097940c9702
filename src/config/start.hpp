// Checks of what a case starts from.
#pragma once

#include <vector>

#include "src/config/config.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// [initial] against the sections it belongs to, and a cone to pour against the domain.
void check_initial(const Config& config, Findings& found);

/// What does not fit between a case and the case whose end it starts from. `flow`: the start is
/// that of the fluid (initial.fluid), else of the grains (initial.grains).
std::vector<Finding> check_start(const Config& config, const Config& start, bool flow);

}  // namespace barchan
