// What grains have left in the ghosts of a pencil goes to the cells that the ghosts are copies of:
// the adjoint of filling them.
#pragma once

#include "kernels/coupling/deposit.hpp"
#include "src/parallel/messages.hpp"

namespace barchan {

class DepositRims {
 public:
  DepositRims() = default;
  explicit DepositRims(const Grid& grid);

  /// Adds the sums in the ghosts to those of the owned cells across, first along x, then along z.
  /// Integers: the order does not matter. Nothing to do where the grid is not cut. All ranks of the
  /// grid together.
  void add(const Deposits& deposits) const;

 private:
  Grid grid_;
  Rims x_, z_;
};

}  // namespace barchan
