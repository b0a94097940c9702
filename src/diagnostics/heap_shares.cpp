#include "src/diagnostics/heap_shares.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace barchan {

bool are_of_heaps(GrainCloud grains) {
  return std::ranges::any_of(grains, [](const GrainSample& grain) { return grain.heap >= 0; });
}

std::vector<HeapShare> heap_shares(double t, GrainCloud grains, std::span<const int> labels) {
  std::map<std::pair<int, int>, HeapShare> shares;
  for (std::size_t p = 0; p < grains.size(); ++p) {
    const GrainSample& grain = grains[p];
    const int heap = static_cast<int>(grain.heap);
    HeapShare& share = shares[{labels[p], heap}];
    share.t = t;
    share.dune = labels[p];
    share.heap = heap;
    ++share.n_grains;
    share.volume += std::numbers::pi / 6.0 * grain.d * grain.d * grain.d;
  }
  std::vector<HeapShare> rows;
  for (const auto& [place, share] : shares) rows.push_back(share);
  return rows;
}

}  // namespace barchan
