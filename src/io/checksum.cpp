#include "src/io/checksum.hpp"

#include <bit>
#include <type_traits>

namespace barchan {

namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15, kOdd = 0xd6e8feb86659fd93;

constexpr std::uint64_t fold(std::uint64_t s) { return s ^ (s >> 32U); }

/// Checksum of values that lie side by side from the place `index` on.
template <class T>
std::uint64_t checksum_of_run(std::span<const T> values, std::uint64_t index) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  std::uint64_t sum = 0, key = index * kGolden;
  for (const T value : values) {
    key += kGolden;
    sum += fold(fold(std::bit_cast<Bits>(value) + key) * kOdd);
  }
  return sum;
}

}  // namespace

template <class T>
std::uint64_t checksum(std::span<const T> values, const Extents& size, const Extents& whole,
                       const Extents& first) {
  if (values.empty()) return 0;
  // Dimensions that the share has wholly, and the one before them, lie side by side.
  std::size_t outer = size.size() - 1;
  std::uint64_t run = size[outer];
  while (outer > 0 && size[outer] == whole[outer]) run *= size[--outer];
  std::uint64_t sum = 0;
  for (std::uint64_t begin = 0; begin < values.size(); begin += run) {
    std::uint64_t index = 0, stride = 1, rest = begin;
    for (std::size_t d = size.size(); d-- > 0; stride *= whole[d], rest /= size[d]) {
      index += (first[d] + rest % size[d]) * stride;
    }
    sum += checksum_of_run(values.subspan(begin, run), index);
  }
  return sum;
}
template std::uint64_t checksum(std::span<const float>, const Extents&, const Extents&,
                                const Extents&);
template std::uint64_t checksum(std::span<const double>, const Extents&, const Extents&,
                                const Extents&);
template std::uint64_t checksum(std::span<const std::int32_t>, const Extents&, const Extents&,
                                const Extents&);
template std::uint64_t checksum(std::span<const std::int64_t>, const Extents&, const Extents&,
                                const Extents&);

}  // namespace barchan
