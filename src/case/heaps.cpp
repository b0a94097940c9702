#include "src/case/heaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {

double poured_spacing(const std::vector<SizeClass>& sizes) {
  double widest = 0;
  for (const SizeClass& size : sizes) widest = std::max(widest, size.diameter * size.wide);
  return 1.01 * widest;
}

double poured_spacing(const HeapConfig& heap) { return heap.spacing * poured_spacing(heap.sizes); }

double poured_height(const HeapConfig& heap, const std::array<double, 3>& domain) {
  const auto n = static_cast<double>(count_of(heap.sizes));
  const double volume = n * std::pow(poured_spacing(heap), 3) / std::numbers::sqrt2;
  if (heap.shape == HeapShape::bed) return volume / (domain[0] * domain[2]);
  if (heap.shape == HeapShape::ridge) return volume / (heap.radius * domain[2]);
  return 3 * volume / (std::numbers::pi * heap.radius * heap.radius);
}

double poured_top(const std::vector<HeapConfig>& heaps, const std::array<double, 3>& domain) {
  double ground = 0, highest = 0;
  for (const HeapConfig& heap : heaps) {
    const double top = ground + heap.drop_height + poured_height(heap, domain);
    highest = std::max(highest, top);
    if (heap.shape == HeapShape::bed) ground = top;
  }
  return highest;
}

std::vector<HeapConfig> poured_heaps(const Config& config) {
  const InitialConfig& initial = config.initial;
  if (!config.grains) return {};
  std::vector<SizeClass> all = poured_sizes(*config.grains);
  const std::vector<KindConfig> kinds = all_kinds(*config.grains);
  const auto set_widths = [&kinds](std::vector<SizeClass>& sizes) {
    for (SizeClass& size : sizes)
      size.wide = width_of(kinds[static_cast<std::size_t>(size.kind)].shape);
  };
  set_widths(all);
  std::vector<HeapConfig> heaps = initial.pour ? std::vector{*initial.pour} : initial.heaps;
  for (std::size_t n = 0; n < heaps.size(); ++n) {
    HeapConfig& heap = heaps[n];
    heap.seed += static_cast<std::uint64_t>(initial.realisation - 1);
    if (heap.name.empty() && !initial.pour) heap.name = fmt::format("heap {}", n + 1);
    const int kind = kind_of_name(*config.grains, heap.kind);
    for (SizeClass& size : heap.sizes) size.kind = std::max(kind, 0);
    set_widths(heap.sizes);
    if (!heap.sizes.empty()) continue;
    std::ranges::copy_if(all, std::back_inserter(heap.sizes), [&](const SizeClass& size) {
      return heap.kind.empty() || size.kind == kind;
    });
  }
  return heaps;
}

std::int64_t count_of(const std::vector<SizeClass>& sizes) {
  std::int64_t count = 0;
  for (const SizeClass& size : sizes) count += size.count;
  return count;
}

std::vector<SizeClass> sizes_of(const std::vector<HeapConfig>& heaps) {
  std::vector<SizeClass> sizes;
  for (const HeapConfig& heap : heaps) {
    if (heap.sizes.empty()) return {};
    sizes.insert(sizes.end(), heap.sizes.begin(), heap.sizes.end());
  }
  return sizes;
}

}  // namespace barchan
