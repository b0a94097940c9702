// Results of reductions that stay on the device until the host asks for them.
#pragma once

#include <type_traits>

#include "kernels/math/device_scalar.hpp"
#include "src/parallel/exchange.hpp"

namespace barchan {

/// Numbers on the device that reductions write without a wait. The host gets a copy of all at once.
class DeviceReductions {
  using Memory = Kokkos::DefaultExecutionSpace::memory_space;

 public:
  DeviceReductions(const char* label, std::size_t n);

  /// Place where a reduction leaves its result, a Real or a struct of Reals.
  template <class T = Real>
  Kokkos::View<T, Memory> into(int slot) const {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Real) == 0);
    return Kokkos::View<T, Memory>(reinterpret_cast<T*>(on_device_.data() + slot));
  }
  Kokkos::Max<Real, Memory> largest_into(int slot) const {
    return Kokkos::Max<Real, Memory>(into(slot));
  }
  DeviceScalar scalar(int slot) const { return DeviceScalar(on_device_.data() + slot); }
  /// Numbers on the device, for kernels.
  Real* data() const { return on_device_.data(); }

  /// Combines [slot, slot + n) over ranks, which waits; does nothing on one rank.
  void combine(MPI_Comm ranks, int slot, int n, MPI_Op operation) const;
  /// Copies all numbers to the host, which has them after a fence.
  void copy_to_host() const {
    Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), on_host_, on_device_);
  }
  /// Copies all numbers to the host, and waits.
  void fetch() const { Kokkos::deep_copy(on_host_, on_device_); }
  /// Number in a slot, as it was fetched.
  template <class T = Real>
  T get(int slot) const {
    return *reinterpret_cast<const T*>(on_host_.data() + slot);
  }

 private:
  Kokkos::View<Real*> on_device_;
  Kokkos::View<Real*>::host_mirror_type on_host_;
};

}  // namespace barchan
