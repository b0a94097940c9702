// Grains poured to heaps and beds.
#pragma once

#include <array>
#include <vector>

#include "src/grains/initial_grains.hpp"

namespace barchan {

struct Bodies;
struct HeapConfig;

/// Pours heaps of hexagonal close packed sites 1 % wider than the largest grain, jittered by 0.2 %.
/// They hold the grains of their sizes, of all kinds, in random order: no overlap, no order that
/// survives the collapse. Sites fill a cone or a ridge from its axis outward and upward, or a bed
/// from the floor up, so the number of grains decides the height. Each heap stands on the beds
/// before it. Sites that reach into a body stay empty. Grains are numbered heap by heap, and know
/// theirs if there are several. `heaps`: see poured_heaps(). Throws std::runtime_error if a heap
/// leaves the domain [m].
InitialGrains pour_grains(const std::vector<HeapConfig>& heaps, const std::array<double, 3>& domain,
                          const Bodies& bodies);
InitialGrains pour_grains(const std::vector<HeapConfig>& heaps,
                          const std::array<double, 3>& domain);

/// Packs the same heaps to about the density to which they settle, for measurements of time: a
/// grain touches about four others, as in a heap at rest. Overlaps are up to half a diameter. Each
/// grain is moved out of the body that it is deepest in.
InitialGrains packed_grains(const std::vector<HeapConfig>& heaps,
                            const std::array<double, 3>& domain, const Bodies& bodies);
InitialGrains packed_grains(const std::vector<HeapConfig>& heaps,
                            const std::array<double, 3>& domain);

}  // namespace barchan
