// One-dimensional Fourier transforms of many lines. By FFTW on the host
// (line_fft_fftw.cpp) or by cuFFT on the device (line_fft_cufft.cpp): CMake takes one of the two.
#pragma once

#include <cstddef>
#include <memory>

#include "kernels/fluid/tridiagonal.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Real lines along x: number i of a row of a plane is at i + row row_stride + plane plane_stride.
struct RealLines {
  int n = 0, rows = 0, planes = 0;
  std::ptrdiff_t row_stride = 0, plane_stride = 0;

  std::ptrdiff_t modes_per_plane() const { return std::ptrdiff_t{rows} * (n / 2 + 1); }
};

/// Lines along z of a contiguous array (lines, rows, n), the first fastest.
struct ComplexLines {
  int n = 0, lines = 0, rows = 0;
};

/// Order of modes (lines, y, planes), each plane a group.
constexpr ModeGroups plane_by_plane(int lines, int planes) { return {lines, 1, lines, planes}; }

/// Solves all columns of modes that lie group by group in the order of their pivots.
inline void solve_columns(const ColumnSolve& columns, Kokkos::complex<Real>* modes) {
  const int n = columns.pivot.extent_int(0), groups = columns.pivot.extent_int(2);
  const std::ptrdiff_t size = std::ptrdiff_t{n} * columns.ny;
  // On a host all columns of a group, side by side in vectors; on a device one column.
  Kokkos::parallel_for(
      "poisson: columns", items(kOnHost ? groups : groups * n), KOKKOS_LAMBDA(int index) {
        if (kOnHost) {
          columns.solve(modes + size * index, 0, n, index);
        } else {
          const int c = index % n, group = index / n;
          columns.solve(modes + size * group, c, c + 1, group);
        }
      });
}

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
  /// Both, with a solve of all columns in between, in groups of this order.
  void solve_z(Kokkos::complex<Real>* modes, const ColumnSolve& columns) const;
  ModeGroups groups() const;

 private:
  void solve_in_turn(Kokkos::complex<Real>* modes, const ColumnSolve& columns) const {
    forward_z(modes);
    solve_columns(columns, modes);
    backward_z(modes);
  }

  struct Library;  // plans and work space

  RealLines x_;
  ComplexLines z_;
  std::unique_ptr<Library> library_;
};

}  // namespace barchan
