// Grains of a part of another box.
#pragma once

#include "src/case/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Removes the grains whose centres do not lie in the window of the case, and counts places from
/// its corner. Where opposite sides of the box meet, a grain that would overlap another by more
/// than a hundredth of a diameter goes, too; clumps are looked at sphere by sphere, and go where
/// they reach so far into a wall. The others keep their numbers. Throws InputError where none is
/// left. `box`: a length of 0 is not periodic.
void cut_to_window(const Config& config, const PeriodicBox& box, InitialGrains& grains);

}  // namespace barchan
