// Values as the words of messages, bit for bit.
#pragma once

#include <cstdint>

#include "kernels/grain.hpp"

namespace barchan {

/// Words of Real that a value takes in a message.
template <class T>
inline constexpr int words_of = sizeof(T) < sizeof(Real) ? 1 : int(sizeof(T) / sizeof(Real));

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

/// Copies a column of some rows into the records of a message, from their word `offset` on.
template <class Column>
struct PackColumn {
  Column column;
  Kokkos::View<const int*> row;  // of each record; none: its own number
  Real* records;
  int width, offset;  // words of a record; the first one of this column
  KOKKOS_FUNCTION void operator()(int p) const {
    put_words(records + static_cast<std::size_t>(p) * width + offset,
              column(row.extent(0) > 0 ? row(p) : p));
  }
};
/// The way back, to `first_row` and the rows after it where there is no list of rows.
template <class Column>
struct UnpackColumn {
  Column column;
  Kokkos::View<const int*> row;
  int first_row;
  const Real* records;
  int width, offset;
  KOKKOS_FUNCTION void operator()(int p) const {
    take_words(records + static_cast<std::size_t>(p) * width + offset,
               column(row.extent(0) > 0 ? row(p) : first_row + p));
  }
};

}  // namespace barchan
