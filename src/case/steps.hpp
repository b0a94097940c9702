// Steps that the program chooses where a case says "auto", by the rules of docs/choosing.md. They
// follow from the case alone, so a run that goes on has the same.
#pragma once

#include <vector>

#include "src/case/config.hpp"

namespace barchan {

/// Longest fluid step [s] for a CFL number of the mean flow of 0.13 and a viscous number of 0.4,
/// rounded down to one that fits into 0.01 s. Without a flow: 100 grain steps. `sizes`: of the
/// grains, if they are known.
double chosen_fluid_step(const Config& config, const std::vector<SizeClass>& sizes);

/// Longest grain step [s] that is 20 % of the Rayleigh time of the smallest grain, and stable below
/// 15 layers (docs/theory-grains.md, "Stable grain step"). Linear springs take a tenth of the
/// duration of a contact. No step is longer than the thinnest film allows.
double chosen_grain_step(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
