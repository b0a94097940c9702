// Direct solution in y of mass phi - diffusion lap(phi) = f for one Fourier mode in x and z.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Per mode (a, b), a along x: the symmetric finite-volume equations of a column,
///   D_j phi_j - E_j phi_{j-1} - E_{j+1} phi_{j+1} = dy_j f_j,
///   D_j = (mass + diffusion lambda) dy_j + E_j + E_{j+1}, E_j = diffusion / dy_centre_j, 0 on
///   walls,
/// lambda the eigenvalue of -d2/dx2 - d2/dz2 [1/m^2]; solved by factors made once.
/// The pivots 1/(D_j - E_j^2 pivot_{j-1}) of all modes are stored, x fastest.
struct ColumnSolve {
  using Modes = Kokkos::View<Kokkos::complex<Real>***, Kokkos::LayoutLeft>;
  Modes modes;                                      // in: f; out: phi
  Kokkos::View<Real***, Kokkos::LayoutLeft> pivot;  // (kx, j, kz) [m]
  Kokkos::View<Real*> weight;                       // dy_j / (nx nz) [m]
  Kokkos::View<Real*> coupling;                     // E_j, j = 0..ny [1/m]
  int ny = 0;
  bool singular = false;  // mass = 0: the mean of phi is free and set to zero

  KOKKOS_FORCEINLINE_FUNCTION void sweep(int begin, int end, int kz) const {
    for (int j = 0; j < ny; ++j) {
      const Real w = weight(j), e = coupling(j);
      if (j == 0) {
        for (int kx = begin; kx < end; ++kx) modes(kx, 0, kz) *= w;
        continue;
      }
      Kokkos::complex<Real>* here = &modes(0, j, kz);
      const Kokkos::complex<Real>* below = &modes(0, j - 1, kz);
      const Real* q = &pivot(0, j - 1, kz);
#pragma omp simd
      for (int kx = begin; kx < end; ++kx) {
        const Real factor = e * q[kx];
        here[kx].real() = w * here[kx].real() + factor * below[kx].real();
        here[kx].imag() = w * here[kx].imag() + factor * below[kx].imag();
      }
    }
    for (int kx = begin; kx < end; ++kx) modes(kx, ny - 1, kz) *= pivot(kx, ny - 1, kz);
    for (int j = ny - 2; j >= 0; --j) {
      const Real e = coupling(j + 1);
      Kokkos::complex<Real>* here = &modes(0, j, kz);
      const Kokkos::complex<Real>* above = &modes(0, j + 1, kz);
      const Real* q = &pivot(0, j, kz);
#pragma omp simd
      for (int kx = begin; kx < end; ++kx) {
        here[kx].real() = q[kx] * (here[kx].real() + e * above[kx].real());
        here[kx].imag() = q[kx] * (here[kx].imag() + e * above[kx].imag());
      }
    }
  }

  /// Takes the height-weighted mean out of the mode that is constant in x and z.
  KOKKOS_FORCEINLINE_FUNCTION void remove_mean() const {
    Real sum = 0, height = 0;
    for (int j = 0; j < ny; ++j) {
      sum += weight(j) * modes(0, j, 0).real();
      height += weight(j);
    }
    for (int j = 0; j < ny; ++j) modes(0, j, 0).real() -= sum / height;
  }

  /// Columns kx in [begin, end) of plane kz.
  KOKKOS_FORCEINLINE_FUNCTION void solve(int begin, int end, int kz) const {
    const bool has_mean = singular && kz == 0 && begin == 0;
    if (has_mean) remove_mean();
    sweep(begin, end, kz);
    if (has_mean) remove_mean();
  }
};

}  // namespace barchan
