// Periodic ghost cells in x and z.
#pragma once

#include "kernels/grid.hpp"

namespace barchan {

/// Fills the ghosts of grid fields from the cells that own them. One rank owns the whole width
/// now; a decomposed domain exchanges its rims at the same place.
class Halo {
 public:
  explicit Halo(const Grid& grid) : grid_(grid) {}

  /// Makes the ghosts of `f` in x and z valid, rows -1 and ny and the corners included; the rows
  /// behind the walls are taken as they are.
  void fill(const Field& f) const;

 private:
  Grid grid_;
};

}  // namespace barchan
