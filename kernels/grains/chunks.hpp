// Grains in pieces, each of which one thread takes at a time.
#pragma once

#include "kernels/math/on_host.hpp"

namespace barchan {

/// Largest number of entries in a chunk: on a CPU they stay in its L2 cache, on a GPU every entry
/// is a chunk.
inline constexpr int kMaxChunk = kOnHost ? 4096 : 1;

/// Grains in chunks of consecutive entries, each of which one thread takes at a time. The size of a
/// chunk depends on the number of grains alone, so that results do not depend on the number of
/// threads.
struct Chunks {
  int n = 0, size = 1;

  KOKKOS_FORCEINLINE_FUNCTION int count() const { return (n + size - 1) / size; }
  /// Tells if two entries are in one chunk; entries from n on are in none.
  KOKKOS_FORCEINLINE_FUNCTION bool contain_both(int a, int b) const {
    return a < n && b < n && a / size == b / size;
  }
  KOKKOS_FORCEINLINE_FUNCTION int begin(int chunk) const { return chunk * size; }
  KOKKOS_FORCEINLINE_FUNCTION int end(int chunk) const {
    return (chunk + 1) * size < n ? (chunk + 1) * size : n;
  }
};

/// Place of an entry in its chunk: a constant where every entry is one, so that a device keeps what
/// lies there in registers.
KOKKOS_FORCEINLINE_FUNCTION constexpr int place_in_chunk(int entry, int begin) {
  return kOnHost ? entry - begin : 0;
}

/// Divides n grains into chunks. Large chunks have few inter-chunk pairs. A multiple of eight of
/// them shares well among threads, unless that makes them tiny.
inline Chunks make_chunks(int n) {
  const int count = 8 * ((n + 8 * kMaxChunk - 1) / (8 * kMaxChunk));
  const int size = count > 0 ? (n + count - 1) / count : 1;
  const int least = kMaxChunk < 256 ? kMaxChunk : 256;
  return {.n = n, .size = size < least ? least : size};
}

}  // namespace barchan
