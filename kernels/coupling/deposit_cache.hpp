// What grains deposit in cells: integers, whose sums do not depend on the order.
#pragma once

#include <cstdint>

#include "kernels/coupling/void_fraction.hpp"

namespace barchan {

/// What goes into one cell, in fixed point.
struct CellDeposit {
  std::int64_t volume = 0;
  std::int64_t conductance_x = 0,
               conductance_z = 0;  // between layers, for the flow along x, along z
  std::int64_t impulse_x = 0, impulse_y = 0, impulse_z = 0;

  KOKKOS_FORCEINLINE_FUNCTION CellDeposit& operator+=(const CellDeposit& b) {
    volume += b.volume;
    conductance_x += b.conductance_x, conductance_z += b.conductance_z;
    impulse_x += b.impulse_x, impulse_y += b.impulse_y, impulse_z += b.impulse_z;
    return *this;
  }
};

/// Sums over all grains, on owned cells and the ghosts beside them. Of layers the conductances and
/// the impulses along the floor are those of the momentum cells around the faces.
struct Deposits {
  enum Quantity {
    kVolume,
    kConductanceX,
    kConductanceZ,
    kImpulseX,
    kImpulseY,
    kImpulseZ,
    kQuantities,
    kSolidX = kConductanceX,  // of DepositSolid, until the deposit
    kSolidZ = kConductanceZ
  };
  Kokkos::View<std::int64_t* [kQuantities], Kokkos::LayoutLeft> sum;
  FixedPoint volume, conductance, impulse;

  /// At the same time as others.
  KOKKOS_INLINE_FUNCTION void add(std::int64_t cell, const CellDeposit& given) const {
    add(cell, kVolume, given.volume);
    add(cell, kConductanceX, given.conductance_x);
    add(cell, kConductanceZ, given.conductance_z);
    add(cell, kImpulseX, given.impulse_x);
    add(cell, kImpulseY, given.impulse_y);
    add(cell, kImpulseZ, given.impulse_z);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(std::int64_t cell, Quantity q, std::int64_t value) const {
    if (value != 0) Kokkos::atomic_add(&sum(cell, q), value);
  }
};

/// What grains give to cells, on its way to the sums of all. The cells around a column of cells are
/// kept until others take their slots: grains that follow one another in memory share cells, and an
/// atomic addition takes longer than all else. Two columns along x and along z have slots of their
/// own, and so many rows; one slot on a device.
template <int rows>
class DepositCache {
 public:
  static constexpr int kSlots = rows > 1 ? 4 * rows : 1;

  KOKKOS_INLINE_FUNCTION DepositCache(const GridRef& grid, const Deposits& deposits)
      : grid_(grid), deposits_(deposits) {}
  KOKKOS_INLINE_FUNCTION ~DepositCache() {
    for (int slot = 0; slot < kSlots; ++slot) deposits_.add(cell_[slot], held_[slot]);
  }
  DepositCache(const DepositCache&) = delete;

  /// Where to add what a cell is given.
  KOKKOS_FORCEINLINE_FUNCTION CellDeposit& at(const CellIndex& c) {
    const std::int64_t cell = c.linear(grid_);
    const int slot = rows > 1 ? (c.i & 1) + 2 * (c.k & 1) + 4 * (c.j & (rows - 1)) : 0;
    if (cell_[slot] != cell) {
      deposits_.add(cell_[slot], held_[slot]);
      cell_[slot] = cell;
      held_[slot] = {};
    }
    return held_[slot];
  }

 private:
  const GridRef& grid_;
  const Deposits& deposits_;
  std::int64_t cell_[kSlots]{};
  CellDeposit held_[kSlots]{};
};

}  // namespace barchan
