// Checks of what drives the flow.
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// The entries of [[fluid.schedule]] with each other, and with the rest of a case with [fluid].
void check_schedule(const Config& config, Findings& found);

/// initial.fluid "turbulent" and "uniform", which begin at the bulk velocity of t = 0.
void check_flow_at_start(const Config& config, Findings& found);

}  // namespace barchan
