#include "src/parallel/transpose.hpp"

#include "src/parallel/pack.hpp"

namespace barchan {

namespace {

int extent(int begin, int end) { return end - begin; }

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

template <BoxCopy how>
void Transpose::copy(const Side& side, const StridedArray& array) const {
  std::ptrdiff_t start = 0;
  for (std::size_t p = 0; p < side.blocks.size(); ++p) {
    const auto& [begin, end] = side.blocks[p];
    BoxShape box{.width = width_};
    std::ptrdiff_t first = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      box.n[a] = extent(begin[a], end[a]);
      box.stride[a] = width_ * array.stride[a];
      first += begin[a] * box.stride[a];
    }
    if (side.counts[p] > 0) {
      copy_boxes<how>(how == BoxCopy::pack ? "transpose: pack" : "transpose: unpack", box,
                      std::array{array.data + first}, std::array{side.buffer.data() + start});
    }
    start += side.counts[p];
  }
}

void Transpose::move(const Side& from, const StridedArray& source, const Side& to,
                     const StridedArray& target) const {
  copy<BoxCopy::pack>(from, source);
  exchange_all(line_, from.buffer, from.counts, to.buffer, to.counts);
  copy<BoxCopy::unpack>(to, target);
}

void Transpose::join(const StridedArray& cut, const StridedArray& joined) const {
  move(cut_side_, cut, joined_side_, joined);
}

void Transpose::cut(const StridedArray& joined, const StridedArray& cut) const {
  move(joined_side_, joined, cut_side_, cut);
}

}  // namespace barchan
