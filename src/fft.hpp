// Real Fourier transforms over x and z of every row of a grid field.
#pragma once

#include <cstddef>
#include <memory>

#include "kernels/grid.hpp"

namespace barchan {

/// Fourier coefficients (kx, j, kz), kx = 0 .. nx/2 fastest, y untransformed.
using Spectrum = Kokkos::View<Kokkos::complex<Real>***, Kokkos::LayoutLeft>;

/// Both directions without normalisation: backward(forward(f)) = nx nz f. Plans do not depend on
/// timing, so that two runs give the same bits.
class PlaneFft {
 public:
  explicit PlaneFft(const Grid& grid);
  ~PlaneFft();
  PlaneFft(const PlaneFft&) = delete;
  PlaneFft& operator=(const PlaneFft&) = delete;

  Spectrum make_spectrum(const char* label) const;
  void forward(const Field& in, const Spectrum& out) const;
  /// Destroys `in`. Ghosts of `out` are left alone.
  void backward(const Spectrum& in, const Field& out) const;

 private:
  struct Plans;
  void forward_on_host(const Real* in, Kokkos::complex<Real>* out) const;
  void backward_on_host(Kokkos::complex<Real>* in, Real* out) const;

  std::unique_ptr<Plans> plans_;
  int nx_, ny_, nz_;
  std::ptrdiff_t row_, plane_;  // strides of a field's y and z
  // Where fields live on a device: host copies that the transforms work on.
  Field::Storage::host_mirror_type real_;
  Spectrum::host_mirror_type spectrum_;
};

}  // namespace barchan
