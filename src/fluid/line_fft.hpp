// One-dimensional Fourier transforms of many lines. By FFTW on the host
// (line_fft_fftw.cpp) or by cuFFT on the device (line_fft_cufft.cpp): CMake takes one of the two.
#pragma once

#include <cstddef>
#include <memory>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Real lines along x: number i of a row of a plane is at i + row row_stride + plane plane_stride.
struct RealLines {
  int n = 0, rows = 0, planes = 0;
  std::ptrdiff_t row_stride = 0, plane_stride = 0;
  std::ptrdiff_t first = 0;  // where the first starts in its array

  std::ptrdiff_t modes_per_plane() const { return std::ptrdiff_t{rows} * (n / 2 + 1); }
};

/// Lines along z of a contiguous array (lines, rows, n), the first fastest.
struct ComplexLines {
  int n = 0, lines = 0, rows = 0;
};

/// Without normalisation. Plans do not depend on timing, so that two runs give the same bits.
class LineFft {
 public:
  LineFft(const RealLines& x, const ComplexLines& z);
  ~LineFft();
  LineFft(const LineFft&) = delete;
  LineFft& operator=(const LineFft&) = delete;

  /// Between real lines and modes (n / 2 + 1, rows, planes). The backward transform destroys the
  /// modes.
  void forward_x(const Real* real, Kokkos::complex<Real>* modes) const;
  void backward_x(Kokkos::complex<Real>* modes, Real* real) const;
  /// Transform along z, in place.
  void forward_z(Kokkos::complex<Real>* modes) const;
  void backward_z(Kokkos::complex<Real>* modes) const;

 private:
  struct Library;  // plans and work space

  RealLines x_;
  ComplexLines z_;
  std::unique_ptr<Library> library_;
};

}  // namespace barchan
