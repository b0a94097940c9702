// Ghost cells in x and z.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "kernels/fluid/boundary_values.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/grid.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Messages to and from the two neighbours along a direction; that for the rank before comes first.
struct HaloBuffers {
  RankAxis line;
  MessageBuffer send, receive;  // empty where the direction is not cut
  bool is_cut() const { return line.count > 1; }
};

/// Fills the ghosts of grid fields from the cells that own them: on this rank, across the periodic
/// sides, or on the ranks around it. Also adds ghosts to their owners.
class Halo {
 public:
  /// Sums on (cells with ghosts in x and z, quantities), cell (i, j, k) at i + 1 + (nx + 2) (j + ny
  /// (k + 1)).
  using CellSums = Kokkos::View<std::int64_t**, Kokkos::LayoutLeft>;

  /// Makes a halo. `n_sums`: quantities for scatter_add(); 0 where it is not used.
  explicit Halo(const Grid& grid, int n_sums = 0);

  /// Makes all ghosts of some fields valid, behind the walls by their rules, corners included.
  /// Where no direction is cut one launch fills three fields. All ranks call it together.
  void fill_with_walls(std::span<const FieldWithWalls> fields) const;
  /// Makes the ghosts in x and z valid; the rows behind the walls are taken as they are.
  template <std::same_as<Field>... Fields>
  void fill(Fields&... f) const {
    fill_with_walls(std::array{FieldWithWalls{.f = f, .ny = grid_.ny, .walls = {}}...});
  }

  /// Makes those ghosts valid that are copies of other ranks' cells within `bounds`, a range of the
  /// cells of all ranks; corners and what is periodic on this rank are left alone. All ranks call
  /// it together, with the same bounds.
  void fill_between_ranks(const FieldRef& f, const CellRange& bounds) const;

  /// Adjoint of fill(): adds the sums in the ghosts to those of the cells that they are copies of,
  /// first along x, then along z. They are integers, so the order does not matter. Does nothing
  /// where the grid is not cut. All ranks call it together.
  void scatter_add(const CellSums& sums) const;

 private:
  Grid grid_;
  HaloBuffers x_, z_;
};

}  // namespace barchan
