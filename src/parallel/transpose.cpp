#include "src/parallel/transpose.hpp"

#include "src/parallel/pack.hpp"

namespace barchan {

Transpose::Transpose(const RankAxis& line, std::array<int, 3> whole, std::size_t shared,
                     std::size_t split, int width)
    : line_(line), width_(width), cut_(whole), joined_(whole) {
  const BlockPartition of_shared{.n = whole[shared], .parts = line.count};
  const BlockPartition of_split{.n = whole[split], .parts = line.count};
  cut_[shared] = of_shared.count(line.position);
  joined_[split] = of_split.count(line.position);
  if (is_trivial()) return;
  cut_side_ = make_side(cut_, split, of_split, "transpose: cut");
  joined_side_ = make_side(joined_, shared, of_shared, "transpose: joined");
}

Transpose::Side Transpose::make_side(const std::array<int, 3>& extents, std::size_t axis,
                                     const BlockPartition& split, const char* label) const {
  std::vector<int> planes;
  for (int rank = 0; rank < line_.count; ++rank) planes.push_back(split.count(rank));
  const int all = width_ * extents[0] * extents[1] * extents[2];
  const int of_plane = extents[axis] > 0 ? all / extents[axis] : 0;
  return {extents, axis, split, consecutive_blocks(planes, of_plane),
          MessageBuffer(label, static_cast<std::size_t>(all))};
}

template <BoxCopy how>
void Transpose::copy(const Side& side, const StridedArray& array) const {
  for (const MessageBlock& block : side.blocks) {
    if (block.n == 0) continue;
    BoxShape box{.n = side.extents, .stride = array.stride, .width = width_};
    box.n[side.axis] = side.split.count(block.rank);
    for (auto& stride : box.stride) stride *= width_;
    const std::ptrdiff_t first = side.split.begin(block.rank) * box.stride[side.axis];
    copy_boxes<how>(how == BoxCopy::pack ? "transpose: pack" : "transpose: unpack", box,
                    std::array{array.data + first}, std::array{side.buffer.data() + block.begin});
  }
}

void Transpose::move(const Side& from, const StridedArray& source, const Side& to,
                     const StridedArray& target) const {
  copy<BoxCopy::pack>(from, source);
  exchange(line_.communicator, from.buffer, from.blocks, to.buffer, to.blocks);
  copy<BoxCopy::unpack>(to, target);
}

}  // namespace barchan
