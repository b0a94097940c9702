#include "src/parallel/transpose.hpp"

#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

int extent(int begin, int end) { return end - begin; }

/// Elements of a block to or from their places in a message.
template <bool pack>
struct CopyBlock {
  Real* array;
  std::ptrdiff_t stride_x, stride_y, stride_z;
  int x0, y0, z0, nx, ny;  // of the block
  int width;
  Real* message;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    Real* element = array + width * (i * stride_x + j * stride_y + k * stride_z);
    const std::ptrdiff_t place =
        i - x0 + nx * (j - y0 + static_cast<std::ptrdiff_t>(ny) * (k - z0));
    Real* in_message = message + width * place;
    for (int c = 0; c < width; ++c) {
      if constexpr (pack) {
        in_message[c] = element[c];
      } else {
        element[c] = in_message[c];
      }
    }
  }
};

}  // namespace

Transpose::Transpose(const RankLine& line, std::array<int, 3> whole, int shared, int split,
                     int width)
    : line_(line), width_(width), cut_(whole), joined_(whole) {
  const auto cut_axis = static_cast<std::size_t>(shared);
  const auto joined_axis = static_cast<std::size_t>(split);
  const Split of_shared{.n = whole[cut_axis], .parts = line.count};
  const Split of_split{.n = whole[joined_axis], .parts = line.count};
  cut_[cut_axis] = of_shared.count(line.place);
  joined_[joined_axis] = of_split.count(line.place);
  if (is_trivial()) return;
  cut_side_ = make_side(cut_, split, of_split, "transpose: cut");
  joined_side_ = make_side(joined_, shared, of_shared, "transpose: joined");
}

Transpose::Side Transpose::make_side(const std::array<int, 3>& extents, int axis,
                                     const Split& split, const char* label) const {
  Side side;
  std::size_t all = 0;
  for (int place = 0; place < line_.count; ++place) {
    Block block{.begin = {}, .end = extents};
    block.begin[static_cast<std::size_t>(axis)] = split.begin(place);
    block.end[static_cast<std::size_t>(axis)] = split.begin(place + 1);
    int numbers = width_;
    for (std::size_t a = 0; a < 3; ++a) numbers *= extent(block.begin[a], block.end[a]);
    side.blocks.push_back(block);
    side.counts.push_back(numbers);
    all += static_cast<std::size_t>(numbers);
  }
  side.buffer = MessageBuffer(label, all);
  return side;
}

template <bool pack>
void Transpose::copy(const Side& side, const StridedArray& array) const {
  std::ptrdiff_t start = 0;
  for (std::size_t p = 0; p < side.blocks.size(); ++p) {
    const auto& [begin, end] = side.blocks[p];
    const CellRange range{begin[0], end[0], begin[1], end[1], begin[2], end[2]};
    if (side.counts[p] > 0) {
      for_each_cell(pack ? "transpose: pack" : "transpose: unpack", range,
                    CopyBlock<pack>{array.data, array.stride[0], array.stride[1], array.stride[2],
                                    begin[0], begin[1], begin[2], extent(begin[0], end[0]),
                                    extent(begin[1], end[1]), width_, side.buffer.data() + start});
    }
    start += side.counts[p];
  }
}

void Transpose::move(const Side& from, const StridedArray& source, const Side& to,
                     const StridedArray& target) const {
  copy<true>(from, source);
  exchange_all(line_, from.buffer, from.counts, to.buffer, to.counts);
  copy<false>(to, target);
}

void Transpose::join(const StridedArray& cut, const StridedArray& joined) const {
  move(cut_side_, cut, joined_side_, joined);
}

void Transpose::cut(const StridedArray& joined, const StridedArray& cut) const {
  move(joined_side_, joined, cut_side_, cut);
}

}  // namespace barchan
