// Values as the words of messages, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernels/grains/grain.hpp"

namespace barchan {

KOKKOS_FORCEINLINE_FUNCTION void put_words(Real* to, Real a) { to[0] = a; }
KOKKOS_FORCEINLINE_FUNCTION void put_words(Real* to, std::uint8_t a) { to[0] = a; }
KOKKOS_FORCEINLINE_FUNCTION void put_words(Real* to, std::int64_t a) {
  to[0] = Kokkos::bit_cast<Real>(a);
}
KOKKOS_FORCEINLINE_FUNCTION void put_words(Real* to, const Vec3& a) {
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
}
KOKKOS_FORCEINLINE_FUNCTION void put_words(Real* to, const Quad& a) {
  to[0] = a.x, to[1] = a.y, to[2] = a.z, to[3] = a.w;
}

KOKKOS_FORCEINLINE_FUNCTION void take_words(const Real* from, Real& a) { a = from[0]; }
KOKKOS_FORCEINLINE_FUNCTION void take_words(const Real* from, std::uint8_t& a) {
  a = static_cast<std::uint8_t>(from[0]);
}
KOKKOS_FORCEINLINE_FUNCTION void take_words(const Real* from, std::int64_t& a) {
  a = Kokkos::bit_cast<std::int64_t>(from[0]);
}
KOKKOS_FORCEINLINE_FUNCTION void take_words(const Real* from, Vec3& a) {
  a = {from[0], from[1], from[2]};
}
KOKKOS_FORCEINLINE_FUNCTION void take_words(const Real* from, Quad& a) {
  a = {from[0], from[1], from[2], from[3]};
}

/// Columns of numbers of the same rows, one entry of each making a record of a message.
struct RecordLayout {
  static constexpr int kMost = 24;
  struct Column {
    char* data;
    std::int16_t stride;  // [bytes]
    std::int16_t words;   // 0: a single byte, a word in the record
  };
  Column column[kMost];
  int n = 0, width = 0;  // columns; words of a record

  /// `words` of eight bytes at data and every `stride` bytes from there on; words = 0 for a byte.
  void add(void* data, std::size_t stride, std::size_t words) {
    column[n++] = {static_cast<char*>(data), static_cast<std::int16_t>(stride),
                   static_cast<std::int16_t>(words)};
    width += words > 0 ? static_cast<int>(words) : 1;
  }
};

/// Writes the records of rows, one after the other.
struct PackRecords {
  RecordLayout layout;
  Kokkos::View<const int*> row;  // of each record; none: its own number
  Real* records;
  int width;  // of a record, with words that others fill

  KOKKOS_FUNCTION void operator()(int p) const {
    const std::ptrdiff_t r = row.extent(0) > 0 ? row(p) : p;
    Real* to = records + std::ptrdiff_t{width} * p;
    for (int c = 0; c < layout.n; ++c) {
      const RecordLayout::Column& column = layout.column[c];
      const char* from = column.data + r * column.stride;
      if (column.words == 0) {
        put_words(to++, *reinterpret_cast<const std::uint8_t*>(from));
        continue;
      }
      std::memcpy(to, from, sizeof(Real) * static_cast<std::size_t>(column.words));
      to += column.words;
    }
  }
};
/// The way back, to `first_row` and the rows after it where there is no list of rows.
struct UnpackRecords {
  RecordLayout layout;
  Kokkos::View<const int*> row;
  int first_row;
  const Real* records;
  int width;

  KOKKOS_FUNCTION void operator()(int p) const {
    const std::ptrdiff_t r = row.extent(0) > 0 ? row(p) : first_row + p;
    const Real* from = records + std::ptrdiff_t{width} * p;
    for (int c = 0; c < layout.n; ++c) {
      const RecordLayout::Column& column = layout.column[c];
      char* to = column.data + r * column.stride;
      if (column.words == 0) {
        take_words(from++, *reinterpret_cast<std::uint8_t*>(to));
        continue;
      }
      std::memcpy(to, from, sizeof(Real) * static_cast<std::size_t>(column.words));
      from += column.words;
    }
  }
};

}  // namespace barchan
