// What grains deposit in cells: integers, whose sums do not depend on the order.
#pragma once

#include <cstdint>

#include "kernels/coupling/void_fraction.hpp"

namespace barchan {

/// What goes into one cell, in fixed point.
struct CellDeposit {
  std::int64_t volume = 0;
  std::int64_t conductance_x = 0, conductance_z = 0;  // between rows, for the flow along x, along z
  std::int64_t impulse_x = 0, impulse_y = 0, impulse_z = 0;

  KOKKOS_FORCEINLINE_FUNCTION CellDeposit& operator+=(const CellDeposit& b) {
    volume += b.volume;
    conductance_x += b.conductance_x, conductance_z += b.conductance_z;
    impulse_x += b.impulse_x, impulse_y += b.impulse_y, impulse_z += b.impulse_z;
    return *this;
  }
};

/// Sums over all grains, on owned cells and the ghosts beside them. By row the conductances and the
/// impulses along the floor are those of the momentum cells around the faces.
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

/// What grains give to cells, on its way to the sums of all. A few cells are kept until others take
/// their slots: grains that follow one another in memory share cells, and an atomic addition takes
/// longer than all else.
template <int slots>
class DepositCache {
 public:
  KOKKOS_INLINE_FUNCTION explicit DepositCache(const Deposits& deposits) : deposits_(deposits) {}
  KOKKOS_INLINE_FUNCTION ~DepositCache() {
    for (int slot = 0; slot < slots; ++slot) deposits_.add(cell_[slot], held_[slot]);
  }
  DepositCache(const DepositCache&) = delete;

  KOKKOS_INLINE_FUNCTION void add(std::int64_t cell, const CellDeposit& given) {
    const auto slot = static_cast<int>(cell % slots);
    if (cell_[slot] != cell) {
      deposits_.add(cell_[slot], held_[slot]);
      cell_[slot] = cell;
      held_[slot] = {};
    }
    held_[slot] += given;
  }

 private:
  const Deposits& deposits_;
  std::int64_t cell_[slots]{};
  CellDeposit held_[slots]{};
};

}  // namespace barchan
