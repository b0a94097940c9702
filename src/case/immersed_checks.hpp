// Checks of grains that move in a flow resolved around them. The case has [fluid] and [grains].
#pragma once

#include "src/case/derived.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks what such a case must not have.
void check_immersed(const Config& config, Findings& found);
/// Checks cells against grains, whose sizes are known.
void check_immersed_cells(const Config& config, const GrainNumbers& numbers, Findings& found);

}  // namespace barchan
