#include "src/parallel/column_map.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "src/parallel/exchange.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

/// Marks columns in which a field is not one: on a host a plane a work item, on a device a column.
struct MarkNotOne {
  ConstFieldRef field;
  int nx, ny;
  Kokkos::View<int*> marks;  // (nx, nz)

  KOKKOS_FUNCTION void operator()(int item, int& top) const {
    const int k = kOnHost ? item : item / nx;
    const int begin = kOnHost ? 0 : item % nx, end = kOnHost ? nx : begin + 1;
    int* const mark = marks.data() + static_cast<std::ptrdiff_t>(nx) * k;
    for (int j = 0; j < ny; ++j) {
      int found = 0;
#pragma omp simd reduction(| : found)
      for (int i = begin; i < end; ++i) {
        const int here = field(i, j, k) != 1 ? 1 : 0;
        mark[i] |= here;
        found |= here;
      }
      top = found != 0 && j + 1 > top ? j + 1 : top;
    }
  }
};

}  // namespace

ColumnMap::ColumnMap(const Grid& grid)
    : nx_(grid.nx_all), ny_(grid.ny), nz_(grid.nz_all), on_(index(0, nz_), 0) {}

ColumnMap ColumnMap::everything(const Grid& grid) {
  ColumnMap all(grid);
  std::fill(all.on_.begin(), all.on_.end(), 1);
  all.top_ = grid.ny;
  return all;
}

ColumnMap ColumnMap::not_one(const Grid& grid, const Field& field, const ColumnMarks& room) {
  Kokkos::deep_copy(room.on_device, 0);
  int top = 0;
  Kokkos::parallel_reduce("columns: not one", items(kOnHost ? grid.nz : grid.nx * grid.nz),
                          MarkNotOne{field, grid.nx, grid.ny, room.on_device},
                          Kokkos::Max<int>(top));
  Kokkos::deep_copy(room.on_host, room.on_device);
  ColumnMap map(grid);
  for (int k = 0; k < grid.nz; ++k) {
    for (int i = 0; i < grid.nx; ++i)
      map.on_[map.index(grid.i_begin + i, grid.k_begin + k)] =
          room.on_host(static_cast<std::size_t>(i + grid.nx * k)) != 0;
  }
  map.top_ = std::max(top, 0);
  map.unite_ranks(grid);
  return map;
}

ColumnMap ColumnMap::marked(const Grid& grid, const ColumnMarks& marks, int top) {
  Kokkos::deep_copy(marks.on_host, marks.on_device);
  ColumnMap map(grid);
  for (std::size_t column = 0; column < map.on_.size(); ++column)
    map.on_[column] = marks.on_host(column) != 0;
  map.top_ = top;
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

ColumnMap ColumnMap::in_blocks(int width) const {
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

ColumnMap ColumnMap::grown(int by) const {
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

std::vector<ColumnMap::Interval> ColumnMap::stretches_of_x(int apart) const {
  std::vector<std::uint8_t> any(static_cast<std::size_t>(nx_), 0);
  for (int k = 0; k < nz_; ++k) {
    for (int i = 0; i < nx_; ++i) any[static_cast<std::size_t>(i)] |= on_[index(i, k)];
  }
  std::vector<Interval> found;
  for (int i = 0; i < nx_; ++i) {
    if (any[static_cast<std::size_t>(i)] == 0) continue;
    if (found.empty() || i - found.back().last >= apart) found.push_back({i, i});
    found.back().last = i + 1;
  }
  if (found.size() > 1 && found.front().first + nx_ - found.back().last < apart) {
    found.back().last = found.front().last + nx_;
    found.erase(found.begin());
  }
  return found;
}

}  // namespace barchan
