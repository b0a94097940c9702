// Table heaps.csv: the heaps that the grains of each dune came from.
#pragma once

#include <array>
#include <vector>

#include "src/diagnostics/dune_map.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

/// Grains of one heap in one dune.
struct HeapShare {
  double t = 0;           // [s]
  std::int64_t dune = 0;  // label; -1: in none
  std::int64_t heap = 0;
  std::int64_t n_grains = 0;
  double volume = 0;  // [m^3]
};

inline constexpr std::array kHeapColumns = [] {
  using H = HeapShare;
  return std::to_array<Column<H>>({
      {"t", "s", &H::t, "time", 10},
      {"dune", "-", &H::dune, "label of the dune as in `dune.csv`; -1: in none"},
      {"heap", "-", &H::heap, "heap of origin, as in `grains.h5`; -1: none"},
      {"n_grains", "-", &H::n_grains, "grains of this heap in this dune"},
      {"volume", "m3", &H::volume, "solid volume of these grains, sum of pi d^3/6"},
  });
}();
inline constexpr CsvTable<HeapShare> kHeapTable{"heaps.csv", kHeapColumns};

/// Tells if any of the grains came from one of several heaps.
bool are_of_heaps(GrainCloud grains);

/// Shares of heaps in dunes: one for each dune and heap that have grains in common, in order of
/// dune, then heap. `labels`: the dune of each grain, -1: none.
std::vector<HeapShare> heap_shares(double t, GrainCloud grains, std::span<const int> labels);

}  // namespace barchan
