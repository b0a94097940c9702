// Checks of [grains].
#pragma once

#include "src/config/config.hpp"
#include "src/config/derived.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// The keys of [grains] against each other and against the fluid. `config` has the section.
void check_grains(const Config& config, Findings& found);

/// The grain step against what limits it: the Rayleigh time, or the duration of a linear contact.
void check_grain_step(const Config& config, const GrainNumbers& numbers, Findings& found);

}  // namespace barchan
