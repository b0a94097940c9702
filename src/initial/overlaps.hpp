// Grains that overlap each other or a body at the start.
#pragma once

#include <string>

#include "src/grains/clumps.hpp"

namespace barchan {

/// Refuses the grains of `source` if two of them overlap by more than `most` of their mean diameter
/// (grains.max_overlap): the run would stop at once, or they would fly apart. Throws InputError
/// with the deepest overlap. The grains lie in the box, a length of 0 is not periodic.
void check_overlaps(const InitialGrains& grains, const PeriodicBox& box, double most,
                    const std::string& source);

/// Refuses the grains of `source` if the centre of one lies in a body, or, where grains move, if
/// one reaches into it by more than grains.max_overlap of its diameter. Throws InputError with
/// their number and the deepest one.
void check_outside_bodies(const InitialGrains& grains, const GrainsCase& config,
                          const std::string& source);

/// Refuses a feed none of whose places is free of bodies, neither for the smallest grain nor for
/// the largest, by the spheres around them. Throws InputError.
void check_feed_places(const GrainsCase& config, const Widths& widths);

}  // namespace barchan
