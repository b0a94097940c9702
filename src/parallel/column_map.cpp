#include "src/parallel/column_map.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "src/parallel/exchange.hpp"

namespace barchan {

namespace {

/// Stretches of a periodic line that are marked, each `apart` or more from the next.
std::vector<ColumnMap::Interval> stretches(const std::vector<std::uint8_t>& marked, int apart) {
  const int n = static_cast<int>(marked.size());
  std::vector<ColumnMap::Interval> found;
  for (int i = 0; i < n; ++i) {
    if (marked[static_cast<std::size_t>(i)] == 0) continue;
    if (found.empty() || i - found.back().last >= apart) found.push_back({i, i});
    found.back().last = i + 1;
  }
  if (found.size() > 1 && found.front().first + n - found.back().last < apart) {
    found.back().last = found.front().last + n;
    found.erase(found.begin());
  }
  return found;
}

}  // namespace

ColumnMap::ColumnMap(const Grid& grid)
    : nx_(grid.nx_all), ny_(grid.ny), nz_(grid.nz_all), on_(index(0, nz_), 0) {}

ColumnMap ColumnMap::everything(const Grid& grid) {
  ColumnMap all(grid);
  std::fill(all.on_.begin(), all.on_.end(), 1);
  all.top_ = grid.ny;
  return all;
}

ColumnMap ColumnMap::marked(const Grid& grid, const ColumnMarks& marks, int row) {
  ColumnMap map(grid);
  const int n = grid.nx_all * grid.nz_all;
  for (int column = 0; column < n; ++column)
    map.on_[static_cast<std::size_t>(column)] = marks.on_host(row, column) != 0;
  map.top_ = marks.on_host(row, n);
  map.unite_ranks(grid);
  return map;
}

void ColumnMap::unite_ranks(const Grid& grid) {
  if (grid.ranks == nullptr) return;
  std::vector<std::int64_t> words(1 + (on_.size() + 7) / 8);
  std::memcpy(words.data() + 1, on_.data(), on_.size());
  all_reduce(ranks_of(grid), std::span<std::int64_t>(words).subspan(1), MPI_BOR);
  words[0] = top_;
  all_reduce(ranks_of(grid), std::span<std::int64_t>(words).first(1), MPI_MAX);
  std::memcpy(on_.data(), words.data() + 1, on_.size());
  top_ = static_cast<int>(words[0]);
}

ColumnMap ColumnMap::united(const ColumnMap& other) const {
  if (is_empty()) return other;
  if (other.is_empty()) return *this;
  ColumnMap both = *this;
  for (std::size_t column = 0; column < on_.size(); ++column) both.on_[column] |= other.on_[column];
  both.top_ = std::max(top_, other.top_);
  return both;
}

ColumnMap ColumnMap::padded_to_blocks(int width) const {
  ColumnMap blocks = *this;
  for (int k = 0; k < nz_; ++k) {
    for (int begin = 0; begin < nx_; begin += width) {
      const auto first = blocks.on_.begin() + static_cast<std::ptrdiff_t>(index(begin, k));
      const auto last = first + std::min(width, nx_ - begin);
      if (std::find(first, last, 1) != last) std::fill(first, last, 1);
    }
  }
  return blocks;
}

ColumnMap ColumnMap::dilated(int by) const {
  if (is_empty()) return *this;
  ColumnMap wide = *this, all = *this;
  for (int k = 0; k < nz_; ++k) {
    for (int i = 0; i < nx_; ++i) {
      if (!has(i, k)) continue;
      const bool goes_on = has((i + 1) % nx_, k) && has((i + nx_ - 1) % nx_, k);
      for (int n = -by; n <= by && !goes_on; ++n)
        wide.on_[index(((i + n) % nx_ + nx_) % nx_, k)] = 1;
    }
  }
  for (int k = 0; k < nz_; ++k) {
    for (int n = -by; n <= by; ++n) {
      const int from = ((k + n) % nz_ + nz_) % nz_;
      for (int i = 0; i < nx_; ++i) all.on_[index(i, k)] |= wide.on_[index(i, from)];
    }
  }
  all.top_ = std::min(top_ + by, ny_);
  return all;
}

CellRange ColumnMap::bounds() const {
  CellRange found{.i0 = nx_, .i1 = 0, .j0 = 0, .j1 = top_, .k0 = nz_, .k1 = 0};
  for (int k = 0; k < nz_; ++k) {
    for (int i = 0; i < nx_; ++i) {
      if (!has(i, k)) continue;
      found.i0 = std::min(found.i0, i), found.i1 = std::max(found.i1, i + 1);
      found.k0 = std::min(found.k0, k), found.k1 = k + 1;
    }
  }
  return found;
}

std::vector<ColumnMap::Interval> ColumnMap::stretches_of_x(int apart) const {
  std::vector<std::uint8_t> any(static_cast<std::size_t>(nx_), 0);
  for (int k = 0; k < nz_; ++k) {
    for (int i = 0; i < nx_; ++i) any[static_cast<std::size_t>(i)] |= on_[index(i, k)];
  }
  return stretches(any, apart);
}

std::vector<ColumnMap::Interval> ColumnMap::stretches_of_z(int apart) const {
  std::vector<std::uint8_t> any(static_cast<std::size_t>(nz_), 0);
  for (int k = 0; k < nz_; ++k) {
    for (int i = 0; i < nx_; ++i) any[static_cast<std::size_t>(k)] |= on_[index(i, k)];
  }
  return stretches(any, apart);
}

}  // namespace barchan
