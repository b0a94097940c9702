// A checksum of the values of an array, the same however they are divided among ranks.
#pragma once

#include <cstdint>
#include <span>

#include "src/io/hdf5_file.hpp"

namespace barchan {

/// Sum, modulo 2^64, over the values of h(bits + (index + 1) g), where bits are those of the value
/// as an unsigned number, index is its place in the whole array (row-major, from 0) and
///   h(s) = r(m r(s)), r(s) = s xor floor(s / 2^32), g = 9e3779b97f4a7c15, m = d6e8feb86659fd93
///   (hex).
/// For a given place h is one-to-one, so a change of a single value always changes the sum; others
/// do not with a probability of about 2^-64. `values` have the extents `size` and begin at `first`
/// of an array of the extents `whole`; the sum of the checksums of all shares is that of the array.
template <class T>
std::uint64_t checksum(std::span<const T> values, const Extents& size, const Extents& whole,
                       const Extents& first);

}  // namespace barchan
