// A number that an earlier kernel computes.
#pragma once

#include "kernels/math/on_host.hpp"
#include "kernels/math/vec3.hpp"

namespace barchan {

/// Number that an earlier kernel computes: its value where kernels run on the host, because it is
/// there already; on a device a pointer to where it will be.
class DeviceScalar {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a number is one
  DeviceScalar(Real value) : value_(value) {}
  explicit DeviceScalar(const Real* at) {
    if constexpr (kOnHost) {
      value_ = *at;
    } else {
      at_ = at;
    }
  }
  // NOLINTNEXTLINE(google-explicit-constructor): it is a number
  KOKKOS_FORCEINLINE_FUNCTION operator Real() const {
    if constexpr (kOnHost) return value_;
    return at_ == nullptr ? value_ : *at_;
  }

 private:
  Real value_ = 0;
  const Real* at_ = nullptr;
};

}  // namespace barchan
