// Settled heaps that the workloads start from.
#pragma once

#include <array>
#include <string>

#include "src/grains/initial_grains.hpp"

namespace barchan {

struct Heap {
  InitialGrains grains;
  std::string source;  // file, or "settled here"
};

/// Grains of the paper's sizes at rest around (0.04, 0.05) m: "heap_100k", "heap_10k" from NAME.csv
/// in the folder of --heaps if it is there, else poured and settled for 0.05 s without a fluid, and
/// then kept there. "lattice": 100,000 grains (fewer with --tiny) out of each other's reach.
Heap settled_heap(const std::string& name);

/// Moves a heap to where a domain of this size has room for it, upstream of the middle.
void move_into(InitialGrains& grains, const std::array<double, 3>& domain);

}  // namespace barchan
