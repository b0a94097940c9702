// Deposits of grains in cells: integers, whose sums do not depend on the order.
#pragma once

#include <cstdint>

#include "kernels/coupling/void_fraction.hpp"

namespace barchan {

/// Deposit in one cell, in fixed point.
struct CellDeposit {
  std::int64_t volume = 0;
  std::int64_t interlayer_drag_x = 0,
               interlayer_drag_z = 0;  // between layers, for the flow along x, along z
  std::int64_t impulse_x = 0, impulse_y = 0, impulse_z = 0;

  KOKKOS_FORCEINLINE_FUNCTION CellDeposit& operator+=(const CellDeposit& b) {
    volume += b.volume;
    interlayer_drag_x += b.interlayer_drag_x, interlayer_drag_z += b.interlayer_drag_z;
    impulse_x += b.impulse_x, impulse_y += b.impulse_y, impulse_z += b.impulse_z;
    return *this;
  }
};

/// Sums over all grains, on owned cells and the ghosts beside them. With layers, coefficients of
/// the interlayer drag and impulses along the floor belong to the momentum cells around the faces.
struct Deposits {
  enum Quantity {
    kVolume,
    kInterlayerDragX,
    kInterlayerDragZ,
    kImpulseX,
    kImpulseY,
    kImpulseZ,
    kQuantities,
    kSolidX = kInterlayerDragX,  // from DepositSolid, until the deposit
    kSolidZ = kInterlayerDragZ
  };
  Kokkos::View<std::int64_t* [kQuantities], Kokkos::LayoutLeft> sum;
  FixedPoint volume, interlayer_drag, impulse;

  /// Adds while other threads do.
  KOKKOS_INLINE_FUNCTION void add(std::int64_t cell, const CellDeposit& given) const {
    add(cell, kVolume, given.volume);
    add(cell, kInterlayerDragX, given.interlayer_drag_x);
    add(cell, kInterlayerDragZ, given.interlayer_drag_z);
    add(cell, kImpulseX, given.impulse_x);
    add(cell, kImpulseY, given.impulse_y);
    add(cell, kImpulseZ, given.impulse_z);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(std::int64_t cell, Quantity q, std::int64_t value) const {
    if (value != 0) Kokkos::atomic_add(&sum(cell, q), value);
  }
};

/// Buffer between a grain and the sums of all grains. It keeps the cells around a column of cells
/// until others take their slots: grains that follow one another in memory share cells, and an
/// atomic addition takes longer than all else. It has slots for two columns along x, two along z,
/// and `rows` rows; on a device it is one slot.
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

  /// Slot of a cell, to which deposits are added.
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
