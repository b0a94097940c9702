// Results of reductions that stay on the device until the host asks for them.
#pragma once

#include <type_traits>

#include "kernels/math/late_real.hpp"
#include "src/parallel/exchange.hpp"

namespace barchan {

/// Some numbers on the device, of which the host gets a copy in one go. A reduction into them does
/// not wait.
class Tally {
  using Memory = Kokkos::DefaultExecutionSpace::memory_space;

 public:
  Tally(const char* label, std::size_t n);

  /// Where a reduction leaves its result, a Real or a struct of them.
  template <class T = Real>
  Kokkos::View<T, Memory> into(int slot) const {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Real) == 0);
    return Kokkos::View<T, Memory>(reinterpret_cast<T*>(on_device_.data() + slot));
  }
  Kokkos::Max<Real, Memory> largest_into(int slot) const {
    return Kokkos::Max<Real, Memory>(into(slot));
  }
  LateReal late(int slot) const { return LateReal(on_device_.data() + slot); }
  /// For kernels.
  Real* data() const { return on_device_.data(); }

  /// Combines [slot, slot + n) over ranks, which waits; of one rank there is nothing to do.
  void combine(MPI_Comm ranks, int slot, int n, MPI_Op operation) const;
  /// Brings all to the host, which has it after a fence.
  void copy_to_host() const {
    Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), on_host_, on_device_);
  }
  /// The same, and waits.
  void fetch() const { Kokkos::deep_copy(on_host_, on_device_); }
  /// As it was fetched.
  template <class T = Real>
  T get(int slot) const {
    return *reinterpret_cast<const T*>(on_host_.data() + slot);
  }

 private:
  Kokkos::View<Real*> on_device_;
  Kokkos::View<Real*>::host_mirror_type on_host_;
};

}  // namespace barchan
