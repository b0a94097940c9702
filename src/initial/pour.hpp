// Grains poured to a heap or a bed.
#pragma once

#include <array>
#include <vector>

#include "src/grains/initial_grains.hpp"

namespace barchan {

struct PourConfig;
struct SizeClass;

/// A heap of hexagonal close packed sites 1 % wider than the largest grain, jittered by 0.2 %,
/// holding the grains of `sizes`, of all kinds, in random order: no overlap, no order that survives
/// the collapse. Sites fill a cone of foot radius pour.radius [m] from its axis outward and upward,
/// or a bed from the floor up, so the number of grains decides the height. Throws
/// std::runtime_error if the heap leaves the domain.
InitialGrains pour_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                          const std::array<double, 3>& domain);

/// The same heap moved together to about what it settles to, for measurements of time: a grain
/// touches about four others, as in a heap at rest. Overlaps are up to half a diameter.
InitialGrains packed_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                            const std::array<double, 3>& domain);

}  // namespace barchan
