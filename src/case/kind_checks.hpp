// Checks of the kinds of grains of a case.
#pragma once

#include "src/grains/grains_case.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks [[grains.kind]] and [[grains.pair]] against each other and against the rest of [grains].
void check_kinds(const GrainConfig& grains, Findings& found);

}  // namespace barchan
