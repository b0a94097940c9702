// Grains that overlap at the start.
#pragma once

#include <string>

#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Refuses the grains of `source` if two of them overlap by more than `most` of their mean diameter
/// (grains.max_overlap): the run would stop at once, or they would fly apart. Throws InputError
/// with the deepest overlap. Images beyond periodic sides are not looked at.
void check_overlaps(const InitialGrains& grains, double most, const std::string& source);

}  // namespace barchan
