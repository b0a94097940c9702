// Direct solver of mass phi - diffusion lap(phi) = f: the constant-coefficient pressure equation
// and the smoothing of coupling fields.
#pragma once

#include <memory>

#include "kernels/fluid/tridiagonal.hpp"
#include "src/fluid/fft.hpp"

namespace barchan {

/// Finite volumes on the grid: periodic in x and z or with zero gradient at both ends, as the
/// transforms are; zero gradient on the walls in y. Fourier transforms in x and z, a tridiagonal
/// solve in y with factors made once. Exact to round-off; self-adjoint in the sum over cells
/// weighted with their volume.
class PoissonFft {
 public:
  /// mass [-] >= 0, diffusion [m^2] > 0. mass = 0: the mean of f is dropped, phi has zero mean.
  /// mass = 1, diffusion = L^2: a step of diffusion, which spreads a field over the length L, keeps
  /// its volume integral to round-off and makes no new extrema.
  /// `fft` may be shared between solvers of one grid, but not by solves at the same time.
  PoissonFft(const Grid& grid, std::shared_ptr<const PlaneFft> fft, Real mass, Real diffusion);

  /// in and out may be the same field; ghosts of `out` are left alone.
  void solve(const Field& in, Field& out) const;

 private:
  std::shared_ptr<const PlaneFft> fft_;
  ColumnSolve columns_;
};

}  // namespace barchan
