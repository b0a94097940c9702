// Grains on a loose lattice above the floor, from which they settle into a heap.
#pragma once

#include "src/config/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// A cone of hexagonal close packed sites 1 % wider than the largest grain, jittered by 0.2 %,
/// holding the grains of `sizes` in random order: no overlap, no order that survives the collapse.
/// Sites fill the cone of foot radius pour.radius [m] from its axis outward and upward, so the
/// number of grains decides its height. Throws std::runtime_error if the cone leaves the domain.
InitialGrains pour_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                          const std::array<double, 3>& domain);

}  // namespace barchan
