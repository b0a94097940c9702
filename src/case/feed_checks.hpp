// Checks of grains that come in, and of a window that follows its dune. The case has [grains].
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks a window that follows its dune: grains leave in a strip of two cells.
void check_following(const Config& config, Findings& found);
void check_feed(const Config& config, Findings& found);
/// Checks that the largest of the grains has a place where it comes in; `width` of the sphere
/// around it [m].
void check_fed_sizes(const Config& config, double width, Findings& found);

}  // namespace barchan
