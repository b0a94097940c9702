// Hollows in the grains that a case starts from.
#pragma once

#include <vector>

#include "src/grains/initial_grains.hpp"

namespace barchan {

struct CraterConfig;

/// Removes the grains of each hollow: those whose centre lies within its rim and above the
/// paraboloid y = s - depth (1 - r^2 / radius^2), a volume of pi radius^2 depth / 2 below a level
/// surface. s is the mean height of the surface within the rim [m]. The others keep their numbers.
/// Throws InputError where there are no grains, or none so deep.
void cut_craters(const std::vector<CraterConfig>& craters, InitialGrains& grains);

}  // namespace barchan
