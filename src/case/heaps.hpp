// Heaps and beds that a case pours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/case/config.hpp"

namespace barchan {

/// Distance [m] between poured grains, which stand on a close-packed lattice: 1 % more than the
/// largest.
double poured_spacing(const std::vector<SizeClass>& sizes);
/// The same in a heap, with its `spacing` [m].
double poured_spacing(const HeapConfig& heap);
/// Approximate height [m] to which the grains of a heap fill their cone, ridge or bed.
double poured_height(const HeapConfig& heap, const std::array<double, 3>& domain);
/// Approximate height [m] of the highest grain of all heaps; those after a bed stand on it.
double poured_top(const std::vector<HeapConfig>& heaps, const std::array<double, 3>& domain);

/// The heaps that a case pours, in their order, each with its sizes, its name unless it is `pour`
/// and the seed of the case's realisation; empty: it pours none.
std::vector<HeapConfig> poured_heaps(const Config& config);
/// Number of these grains.
std::int64_t count_of(const std::vector<SizeClass>& sizes);
/// Sizes of the grains of all heaps; empty if those of one are not known.
std::vector<SizeClass> sizes_of(const std::vector<HeapConfig>& heaps);

}  // namespace barchan
