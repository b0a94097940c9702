// Transposes: data that ranks side by side hold in shares of one axis, exchanged into shares of
// another.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/parallel/pack.hpp"

namespace barchan {

/// Array of three axes: element (i, j, k) at i s0 + j s1 + k s2, of `width` numbers each.
struct StridedArray {
  Real* data = nullptr;
  std::array<std::ptrdiff_t, 3> stride{};
};

/// Transpose between two arrays. "Cut" arrays have a share of the axis `shared` and all of the axis
/// `split` on each rank of a line, "joined" ones all of `shared` and a share of `split`. Elements
/// are real (width 1) or complex (2).
class Transpose {
 public:
  /// Plans the transpose. `whole`: extents with both axes whole.
  Transpose(const RankAxis& line, std::array<int, 3> whole, std::size_t shared, std::size_t split,
            int width);

  /// Tells if the line has one rank: both arrays are then the same, and nothing has to move.
  bool is_trivial() const { return line_.count == 1; }
  std::array<int, 3> cut_extents() const { return cut_; }
  std::array<int, 3> joined_extents() const { return joined_; }
  void join(const StridedArray& cut, const StridedArray& joined) const {
    move(cut_side_, cut, joined_side_, joined);
  }
  void cut(const StridedArray& joined, const StridedArray& cut) const {
    move(joined_side_, joined, cut_side_, cut);
  }

 private:
  /// Side of the transpose: an array in blocks along one axis, one for each rank of the line.
  struct Side {
    std::array<int, 3> extents{};
    std::size_t axis = 0;
    BlockPartition split;
    std::vector<MessageBlock> blocks;
    MessageBuffer buffer;
  };
  Side make_side(const std::array<int, 3>& extents, std::size_t axis, const BlockPartition& split,
                 const char* label) const;
  void move(const Side& from, const StridedArray& source, const Side& to,
            const StridedArray& target) const;
  template <BoxCopy how>
  void copy(const Side& side, const StridedArray& array) const;

  RankAxis line_;
  int width_;
  std::array<int, 3> cut_, joined_;
  Side cut_side_, joined_side_;
};

/// Strides of a contiguous array, the first axis fastest.
inline StridedArray contiguous(Real* data, const std::array<int, 3>& extents) {
  return {data, {1, extents[0], static_cast<std::ptrdiff_t>(extents[0]) * extents[1]}};
}

}  // namespace barchan
