// Packing into messages and out of them, bit for bit: entries of arrays, and boxes of strided
// arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "src/parallel/exchange.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Layout of a packed entry: the values of some arrays, one after the other. A message consists of
/// numbers of eight bytes.
struct PackLayout {
  // Largest number of arrays. All arrays of a grain fit, as a test of CoupledOverRanks shows; more
  // would not fit a kernel's arguments. However many columns an array has, it counts as one.
  static constexpr int kMax = 32;
  struct Array {
    char* data;
    std::int32_t column_stride;  // from column to column [numbers of eight bytes]
    std::int16_t stride;         // from entry to entry [bytes]
    // numbers of an entry and column; 0: a single byte, a number in the message
    std::int8_t numbers;
    std::int8_t columns;

    KOKKOS_FUNCTION int width() const { return columns * (numbers > 0 ? numbers : 1); }
    /// Address of an entry in a column.
    KOKKOS_FUNCTION char* address(std::ptrdiff_t entry, int column) const {
      return data + entry * stride +
             static_cast<std::ptrdiff_t>(sizeof(Real)) * column_stride * column;
    }
  };
  Array array[kMax];
  int n = 0, width = 0;  // arrays; numbers of an entry

  /// Adds an array with entries of `bytes` bytes (one, or a multiple of eight) at data and every
  /// `stride` bytes on, in each of some columns. Throws std::length_error beyond kMax.
  void add(void* data, std::size_t stride, std::size_t bytes, std::size_t columns = 1,
           std::size_t column_stride = 0) {
    if (n == kMax) throw std::length_error("PackLayout: too many arrays");
    array[n] = {static_cast<char*>(data), static_cast<std::int32_t>(column_stride),
                static_cast<std::int16_t>(stride), static_cast<std::int8_t>(bytes / sizeof(Real)),
                static_cast<std::int8_t>(columns)};
    width += array[n++].width();
  }
  template <class T>
  void add(const Kokkos::View<T*>& entries) {
    static_assert(sizeof(T) == 1 || sizeof(T) % sizeof(Real) == 0);
    add(entries.data(), sizeof(T), sizeof(T));
  }
  template <class T>
  void add(const Kokkos::View<T**, Kokkos::LayoutLeft>& columns) {
    static_assert(sizeof(T) % sizeof(Real) == 0);
    add(columns.data(), sizeof(T), sizeof(T), columns.extent(1),
        columns.stride(1) * (sizeof(T) / sizeof(Real)));
  }
  /// Adds one member of each entry.
  template <class T, class Member>
  void add(const Kokkos::View<T*>& entries, Member T::*member) {
    add(&(entries.data()->*member), sizeof(T), sizeof(Member));
  }

  /// Offset of an array's part in a packed entry.
  int offset_of(const void* data) const {
    int offset = 0;
    for (int a = 0; a < n && array[a].data != data; ++a) offset += array[a].width();
    return offset;
  }
};

/// Packs entries one after the other.
struct PackEntries {
  PackLayout layout;
  Kokkos::View<const int*> entry;  // entries to pack; empty: 0, 1, ...
  Real* message;

  KOKKOS_FUNCTION void operator()(int p) const {
    const std::ptrdiff_t r = entry.extent(0) > 0 ? entry(p) : p;
    Real* to = message + std::ptrdiff_t{layout.width} * p;
    for (int a = 0; a < layout.n; ++a) {
      const PackLayout::Array& array = layout.array[a];
      for (int c = 0; c < array.columns; ++c) {
        const char* from = array.address(r, c);
        if (array.numbers == 0) *to++ = *reinterpret_cast<const std::uint8_t*>(from);
        for (int q = 0; q < array.numbers; ++q, from += sizeof(Real))
          std::memcpy(to++, from, sizeof(Real));
      }
    }
  }
};
/// Unpacks entries, in the order of a list or one after the other.
struct UnpackEntries {
  PackLayout layout;
  Kokkos::View<const int*> entry;  // entries to fill; empty: first_entry and those after it
  int first_entry;
  const Real* message;
  int width;  // numbers of a packed entry, which may hold more than the layout

  KOKKOS_FUNCTION void unpack(int p, std::ptrdiff_t r) const {
    const Real* from = message + std::ptrdiff_t{width} * p;
    for (int a = 0; a < layout.n; ++a) {
      const PackLayout::Array& array = layout.array[a];
      for (int c = 0; c < array.columns; ++c) {
        char* to = array.address(r, c);
        if (array.numbers == 0)
          *reinterpret_cast<std::uint8_t*>(to) = static_cast<std::uint8_t>(*from++);
        for (int q = 0; q < array.numbers; ++q, to += sizeof(Real))
          std::memcpy(to, from++, sizeof(Real));
      }
    }
  }
  KOKKOS_FUNCTION void operator()(int p) const {
    unpack(p, entry.extent(0) > 0 ? entry(p) : first_entry + p);
  }
};

/// Exchange of packed rows, in buffers that serve again.
class EntryExchange {
 public:
  /// Makes an exchange. `name` heads the labels of kernels and memory.
  explicit EntryExchange(const std::string& name)
      : pack_(name + ": pack"),
        unpack_(name + ": unpack"),
        send_(name + ": send", 0),
        receive_(name + ": receive", 0) {}

  /// Packs the entries, those for rank 0 first (empty list: 0, 1, ...), and exchanges them. All
  /// ranks call it together.
  void exchange(const ExchangeCounts& counts, const PackLayout& layout,
                const Kokkos::View<const int*>& entry = {}) {
    send_.reserve(static_cast<std::size_t>(counts.n_to()) * static_cast<std::size_t>(layout.width));
    Kokkos::parallel_for(pack_, items(counts.n_to()), PackEntries{layout, entry, send_.data()});
    width_ = layout.width;
    n_received_ = counts.n_from();
    receive_.reserve(static_cast<std::size_t>(n_received_) * static_cast<std::size_t>(width_));
    barchan::exchange(counts.ranks, send_, consecutive_blocks(counts.to, width_), receive_,
                      consecutive_blocks(counts.from, width_));
  }
  /// Unpacks received entries into those of a list, or into `first_entry` and those after it.
  void unpack(const PackLayout& layout, const Kokkos::View<const int*>& entry,
              int first_entry = 0) const {
    Kokkos::parallel_for(unpack_, items(n_received_), unpacking(layout, entry, first_entry));
  }
  UnpackEntries unpacking(const PackLayout& layout, const Kokkos::View<const int*>& entry,
                          int first_entry) const {
    return {layout, entry, first_entry, receive_.data(), width_};
  }
  /// Received numbers: (entries) of width() numbers.
  const Real* received() const { return receive_.data(); }
  int width() const { return width_; }

 private:
  std::string pack_, unpack_;
  MessageBuffer send_, receive_;
  int width_ = 0, n_received_ = 0;
};

/// Extents of a box in an array of numbers of eight bytes, and the distances between neighbours.
struct BoxShape {
  std::array<int, 3> n{};
  std::array<std::ptrdiff_t, 3> stride{};  // in numbers
  int width = 1;                           // numbers side by side: 1, or 2 if complex
  std::size_t size() const {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
           static_cast<std::size_t>(n[2]) * static_cast<std::size_t>(width);
  }
};
enum class BoxCopy { pack, unpack, add };

/// Copies `count` boxes of one shape, each to or from its message; the first direction is packed
/// fastest.
template <BoxCopy copy, class T, int count, int width>
struct CopyBoxes {
  std::ptrdiff_t stride_0, stride_1, stride_2;
  int n_0, n_1;
  T* first[count];
  std::conditional_t<copy == BoxCopy::pack, Real, const Real>* message[count];

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const std::ptrdiff_t from = i * stride_0 + j * stride_1 + k * stride_2,
                         to = i + n_0 * (j + static_cast<std::ptrdiff_t>(n_1) * k);
    for (int b = 0; b < count; ++b) {
      for (int c = 0; c < width; ++c) {
        T& element = first[b][from + c];
        if constexpr (copy == BoxCopy::pack) {
          message[b][width * to + c] = Kokkos::bit_cast<Real>(element);
        } else if constexpr (copy == BoxCopy::unpack) {
          element = Kokkos::bit_cast<T>(message[b][width * to + c]);
        } else {
          element += Kokkos::bit_cast<T>(message[b][width * to + c]);
        }
      }
    }
  }
};

/// Copies boxes, or adds them, in one launch: box b begins at first[b] and is message[b].
template <BoxCopy copy, class T, std::size_t count, class Number>
void copy_boxes(const char* label, const BoxShape& shape, const std::array<T*, count>& first,
                const std::array<Number*, count>& message) {
  static_assert(sizeof(T) == sizeof(Real));
  const auto& [n, stride, width] = shape;
  const CellRange range{0, n[0], 0, n[1], 0, n[2]};
  const auto run = [&](auto functor) {
    for (std::size_t b = 0; b < count; ++b)
      functor.first[b] = first[b], functor.message[b] = message[b];
    for_each_cell(label, range, functor);
  };
  constexpr int n_boxes = static_cast<int>(count);
  if (width == 1) {
    run(CopyBoxes<copy, T, n_boxes, 1>{stride[0], stride[1], stride[2], n[0], n[1], {}, {}});
  } else {
    run(CopyBoxes<copy, T, n_boxes, 2>{stride[0], stride[1], stride[2], n[0], n[1], {}, {}});
  }
}

}  // namespace barchan
