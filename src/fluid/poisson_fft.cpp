#include "src/fluid/poisson_fft.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

/// Eigenvalue of the periodic second difference -d2/dx2 for mode m of n [1/m^2].
Real eigenvalue(int m, int n, Real spacing) {
  const Real s = std::sin(std::numbers::pi_v<Real> * m / n);
  return 4 * s * s / (spacing * spacing);
}

}  // namespace

PoissonFft::PoissonFft(const Grid& grid, std::shared_ptr<const PlaneFft> fft, Real mass,
                       Real diffusion)
    : fft_(std::move(fft)) {
  const int ny = grid.ny;
  const ModeGroups groups = fft_->groups();
  const int n = groups.columns();
  columns_.ny = ny;
  const bool has_constant = fft_->first_mode_x() == 0 && fft_->first_mode_z() == 0;
  columns_.singular = mass == 0 && has_constant && groups.count() > 0;
  columns_.weight = Kokkos::View<Real*>("poisson: weight", ny);
  columns_.coupling = Kokkos::View<Real*>("poisson: coupling", ny + 1);
  columns_.pivot =
      Kokkos::View<Real***, Kokkos::LayoutLeft>("poisson: pivot", n, ny, groups.count());
  const auto rows = grid.on_host();
  const auto weight = mirror(columns_.weight);
  const auto coupling = mirror(columns_.coupling);
  const auto pivot = mirror(columns_.pivot);
  const int period_x = fft_->period_x(), period_z = fft_->period_z();
  for (int j = 0; j < ny; ++j) weight(j) = rows.dy(j) / (Real(period_x) * period_z);
  for (int j = 1; j < ny; ++j) coupling(j) = diffusion / rows.dy_centre(j);

  for (int group = 0; group < groups.count(); ++group) {
    for (int c = 0; c < n; ++c) {
      const int kx = groups.kx(c, group), kz = groups.kz(c, group);
      const Real lambda = eigenvalue(fft_->first_mode_x() + kx, period_x, grid.dx) +
                          eigenvalue(fft_->first_mode_z() + kz, period_z, grid.dz);
      for (int j = 0; j < ny; ++j) {
        const Real below = j > 0 ? coupling(j) * coupling(j) * pivot(c, j - 1, group) : 0;
        const Real diagonal =
            (mass + diffusion * lambda) * rows.dy(j) + coupling(j) + coupling(j + 1);
        pivot(c, j, group) = kx < groups.all_lines ? 1 / (diagonal - below) : 0;
      }
    }
  }
  // The constant mode has no last pivot; its value there is set and the mean removed afterwards.
  if (columns_.singular) pivot(0, ny - 1, 0) = 0;
  Kokkos::deep_copy(columns_.weight, weight);
  Kokkos::deep_copy(columns_.coupling, coupling);
  Kokkos::deep_copy(columns_.pivot, pivot);
}

void PoissonFft::solve(const Field& in, Field& out) const { fft_->solve(in, columns_, out); }

}  // namespace barchan
