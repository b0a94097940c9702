// Direct solution in y of mass phi - diffusion lap(phi) = f for one Fourier mode in x and z.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Order in which the columns of modes (kx, kz) stand side by side: in groups, each of some lines
/// kx and some planes kz, kx fastest. The last group along x may stand for more lines than there
/// are.
struct ModeGroups {
  int lines = 0, planes = 0;          // of a group
  int all_lines = 0, all_planes = 0;  // of this rank

  KOKKOS_FORCEINLINE_FUNCTION constexpr int columns() const { return lines * planes; }
  KOKKOS_FORCEINLINE_FUNCTION constexpr int along_x() const {
    return lines > 0 ? (all_lines + lines - 1) / lines : 0;
  }
  KOKKOS_FORCEINLINE_FUNCTION constexpr int count() const {
    return along_x() * (all_planes / planes);
  }
  KOKKOS_FORCEINLINE_FUNCTION constexpr int kx(int column, int group) const {
    return group % along_x() * lines + column % lines;
  }
  KOKKOS_FORCEINLINE_FUNCTION constexpr int kz(int column, int group) const {
    return group / along_x() * planes + column / lines;
  }
};

/// Per mode (a, b), a along x: the symmetric finite-volume equations of a column,
///   D_j phi_j - E_j phi_{j-1} - E_{j+1} phi_{j+1} = dy_j f_j,
///   D_j = (mass + diffusion lambda) dy_j + E_j + E_{j+1}, E_j = diffusion / dy_centre_j, 0 on
///   walls,
/// lambda the eigenvalue of -d2/dx2 - d2/dz2 [1/m^2]; solved by factors made once.
/// The pivots 1/(D_j - E_j^2 pivot_{j-1}) of all modes are stored.
struct ColumnSolve {
  using Complex = Kokkos::complex<Real>;
  Kokkos::View<Real***, Kokkos::LayoutLeft> pivot;  // (column, j, group) of ModeGroups [m]
  Kokkos::View<Real*> weight;                       // dy_j / (nx nz) [m]
  Kokkos::View<Real*> coupling;                     // E_j, j = 0..ny [1/m]
  int ny = 0;
  bool singular = false;  // mass = 0: the mean of phi is free and set to zero

  KOKKOS_FORCEINLINE_FUNCTION void sweep(Complex* modes, int begin, int end, int group) const {
    const std::ptrdiff_t row = pivot.extent_int(0);
    for (int j = 0; j < ny; ++j) {
      const Real w = weight(j), e = coupling(j);
      Complex* here = modes + row * j;
      if (j == 0) {
        for (int c = begin; c < end; ++c) here[c] *= w;
        continue;
      }
      const Complex* below = here - row;
      const Real* q = &pivot(0, j - 1, group);
#pragma omp simd
      for (int c = begin; c < end; ++c) {
        const Real factor = e * q[c];
        here[c].real() = w * here[c].real() + factor * below[c].real();
        here[c].imag() = w * here[c].imag() + factor * below[c].imag();
      }
    }
    for (int c = begin; c < end; ++c) modes[row * (ny - 1) + c] *= pivot(c, ny - 1, group);
    for (int j = ny - 2; j >= 0; --j) {
      const Real e = coupling(j + 1);
      Complex* here = modes + row * j;
      const Complex* above = here + row;
      const Real* q = &pivot(0, j, group);
#pragma omp simd
      for (int c = begin; c < end; ++c) {
        here[c].real() = q[c] * (here[c].real() + e * above[c].real());
        here[c].imag() = q[c] * (here[c].imag() + e * above[c].imag());
      }
    }
  }

  /// Takes the height-weighted mean out of the mode that is constant in x and z.
  KOKKOS_FORCEINLINE_FUNCTION void remove_mean(Complex* modes) const {
    const std::ptrdiff_t row = pivot.extent_int(0);
    Real sum = 0, height = 0;
    for (int j = 0; j < ny; ++j) {
      sum += weight(j) * modes[row * j].real();
      height += weight(j);
    }
    for (int j = 0; j < ny; ++j) modes[row * j].real() -= sum / height;
  }

  /// Columns [begin, end) of a group. Its modes (column, j), in: f; out: phi.
  KOKKOS_FORCEINLINE_FUNCTION void solve(Complex* modes, int begin, int end, int group) const {
    const bool has_mean = singular && group == 0 && begin == 0;
    if (has_mean) remove_mean(modes);
    sweep(modes, begin, end, group);
    if (has_mean) remove_mean(modes);
  }
};

}  // namespace barchan
