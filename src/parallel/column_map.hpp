// Which columns of cells are near grains.
#pragma once

#include <cstdint>
#include <vector>

#include "src/parallel/grid.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

/// Marks of columns, made by kernels: not zero, or zero.
struct ColumnMarks {
  Kokkos::View<int*> on_device;
  Kokkos::View<int*>::host_mirror_type on_host;

  ColumnMarks() = default;
  ColumnMarks(const char* label, int columns)
      : on_device(label, static_cast<std::size_t>(columns)), on_host(mirror(on_device)) {}
};

/// Some x-z columns of the cells of all ranks, up to one height: the same on every rank. Small, and
/// made on the host. x and z are periodic.
class ColumnMap {
 public:
  /// None yet.
  ColumnMap() = default;
  explicit ColumnMap(const Grid& grid);

  static ColumnMap everything(const Grid& grid);
  /// Those where a field is not one, up to its highest such cell. `room`: for the columns of this
  /// rank. All ranks together.
  static ColumnMap not_one(const Grid& grid, const Field& field, const ColumnMarks& room);
  /// Those that are marked (i + nx_all k), up to the rows [0, top). All ranks together.
  static ColumnMap marked(const Grid& grid, const ColumnMarks& marks, int top);

  int top() const { return top_; }
  void set_top(int rows) { top_ = rows; }
  bool is_empty() const { return top_ == 0; }
  bool has(int i, int k) const { return on_[index(i, k)] != 0; }

  /// With so many columns and rows more on all sides.
  ColumnMap grown(int by) const;
  ColumnMap united(const ColumnMap& other) const;
  /// With all of each block of so many columns along x that has one: loops over them then fill
  /// whole vectors, and a rest takes as long as many of these.
  ColumnMap in_blocks(int width = 8) const;

  struct Interval {
    int first, last;
  };
  /// The stretches of x that have columns, each with `apart` columns or more to the next, across
  /// the periodic end, too: there `last` is beyond nx_all.
  std::vector<Interval> stretches_of_x(int apart) const;

 private:
  std::size_t index(int i, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(nx_) * static_cast<std::size_t>(k);
  }
  void unite_ranks(const Grid& grid);

  int nx_ = 0, ny_ = 0, nz_ = 0;  // of all ranks
  int top_ = 0;                   // rows
  std::vector<std::uint8_t> on_;  // (nx_, nz_)
};

}  // namespace barchan
