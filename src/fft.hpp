// Real Fourier transforms over x and z of every row of a grid field. By FFTW on the host
// (fft_fftw.cpp) or by cuFFT on the device (fft_cufft.cpp): CMake takes one of the two.
#pragma once

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

  Spectrum make_spectrum(const char* label) const { return Spectrum(label, nx_ / 2 + 1, ny_, nz_); }
  /// Room for one spectrum, for whoever transforms there and back at once.
  const Spectrum& spectrum() const { return spectrum_; }
  void forward(const Field& in, const Spectrum& out) const;
  /// Destroys `in`. Ghosts of `out` are left alone.
  void backward(const Spectrum& in, const Field& out) const;

 private:
  struct Library;  // plans and work space

  int nx_, ny_, nz_;
  Spectrum spectrum_;
  std::unique_ptr<Library> library_;
};

}  // namespace barchan
