// Checks of [[body]].
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks the bodies alone, with each other, and with the domain and the cells.
void check_bodies(const Config& c, Findings& found);

}  // namespace barchan
