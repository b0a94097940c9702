// Checks of the drive of the flow.
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks the entries of [[fluid.schedule]] against each other, and against the rest of a case with
/// [fluid].
void check_schedule(const Config& config, Findings& found);

/// Checks initial.fluid "turbulent" and "uniform", which begin at the bulk velocity of t = 0.
void check_flow_at_start(const Config& config, Findings& found);

}  // namespace barchan
