// Ghost cells in x and z.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "src/parallel/messages.hpp"

namespace barchan {

/// Fills the ghosts of grid fields from the cells that own them: of this rank, across the periodic
/// seams, or of the ranks around it.
class Halo {
 public:
  explicit Halo(const Grid& grid);

  /// Makes the ghosts of `f` in x and z valid, rows -1 and ny and the corners included; the rows
  /// behind the walls are taken as they are. All ranks together.
  void fill(Field& f) const;

 private:
  Grid grid_;
  Rims x_, z_;  // empty where this rank has the whole width
};

}  // namespace barchan
