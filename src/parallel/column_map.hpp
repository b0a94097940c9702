// Columns of cells near grains.
#pragma once

#include <cstdint>
#include <vector>

#include "src/parallel/grid.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

/// Marks of columns of all ranks, made by kernels: a row of marks for each purpose. The last mark
/// of a row is the number of rows of cells that the columns reach up. The others, at i + nx_all k,
/// are zero or not.
struct ColumnMarks {
  Kokkos::View<int**, Kokkos::LayoutRight> on_device;
  Kokkos::View<int**, Kokkos::LayoutRight>::host_mirror_type on_host;

  ColumnMarks() = default;
  ColumnMarks(const char* label, const Grid& grid, int rows)
      : on_device(label, rows, grid.nx_all * grid.nz_all + 1), on_host(mirror(on_device)) {}

  void set_zero() const { Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), on_device, 0); }
  /// Row of marks, for kernels.
  Kokkos::View<int*> row(int row) const { return Kokkos::subview(on_device, row, Kokkos::ALL); }
  /// Copies the marks to the host, which has them after a fence.
  void copy_to_host() const {
    Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), on_host, on_device);
  }
  /// Copies the marks to the host, and waits.
  void fetch() const { Kokkos::deep_copy(on_host, on_device); }
};

/// Set of x-z columns of the cells of all ranks, up to one height: the same on every rank. It is
/// small, and made on the host. x and z are periodic.
class ColumnMap {
 public:
  /// Makes an empty set.
  ColumnMap() = default;
  explicit ColumnMap(const Grid& grid);

  static ColumnMap everything(const Grid& grid);
  /// Set of the marked columns, as they were fetched. All ranks call it together.
  static ColumnMap marked(const Grid& grid, const ColumnMarks& marks, int row);

  int top() const { return top_; }
  void set_top(int rows) { top_ = rows; }
  bool is_empty() const { return top_ == 0; }
  bool has(int i, int k) const { return on_[index(i, k)] != 0; }
  /// Smallest range of cells of all ranks that holds the set.
  CellRange bounds() const;

  /// Set with so many columns and rows more on all sides.
  ColumnMap dilated(int by) const;
  ColumnMap united(const ColumnMap& other) const;
  /// Set with all columns of each block of `width` along x that has one of them: loops over blocks
  /// then fill whole vectors, and a rest would take as long as many of these.
  ColumnMap padded_to_blocks(int width = 8) const;

  struct Interval {
    int first, last;
  };
  /// Stretches of x that have columns, each `apart` columns or more from the next, across the
  /// periodic end, too: there `last` is beyond nx_all.
  std::vector<Interval> stretches_of_x(int apart) const;
  std::vector<Interval> stretches_of_z(int apart) const;  // likewise

 private:
  std::size_t index(int i, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(nx_) * static_cast<std::size_t>(k);
  }
  void unite_ranks(const Grid& grid);

  int nx_ = 0, ny_ = 0, nz_ = 0;  // columns and rows of all ranks
  int top_ = 0;                   // rows
  std::vector<std::uint8_t> on_;  // (nx_, nz_)
};

}  // namespace barchan
