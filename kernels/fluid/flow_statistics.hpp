// What is averaged over planes of constant height for turbulence statistics.
#pragma once

#include "kernels/fluid/momentum.hpp"

namespace barchan {

/// Sums over one row of cells, and over the y-faces below it.
struct PlaneSums {
  enum Quantity : int {
    // on faces and in cells of the row
    u,     // [m/s]
    w,     // [m/s]
    uu,    // [m^2/s^2]
    ww,    // [m^2/s^2]
    p,     // [Pa]
    nu_t,  // [m^2/s]
    // on the y-faces below the row
    vv,       // [m^2/s^2]
    uv,       // flux of x momentum by the resolved flow as the scheme has it [m^2/s^2]
    viscous,  // nu dU/dy [m^2/s^2]
    stress,   // viscous and subgrid stress together [m^2/s^2]
    n_quantities
  };
  Real value[n_quantities] = {};

  KOKKOS_INLINE_FUNCTION PlaneSums& operator+=(const PlaneSums& other) {
    for (int q = 0; q < n_quantities; ++q) value[q] += other.value[q];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Real& operator[](Quantity q) { return value[q]; }
};

/// Values at one (i, k) of the row; j = ny is the top boundary: its faces count, its cells do not.
struct PlaneSample {
  GridRef grid;
  ConstFaceRef u_;
  ConstFieldRef p_, nu_t_;
  StressDivergence stress_;

  KOKKOS_FORCEINLINE_FUNCTION void add(int i, int j, int k, PlaneSums& sums) const {
    const ConstFieldRef &x = u_.x, &y = u_.y;
    if (j < grid.ny) {
      const Real z = u_.z(i, j, k);
      sums[PlaneSums::u] += x(i, j, k);
      sums[PlaneSums::w] += z;
      sums[PlaneSums::uu] += x(i, j, k) * x(i, j, k);
      sums[PlaneSums::ww] += z * z;
      sums[PlaneSums::p] += p_(i, j, k);
      sums[PlaneSums::nu_t] += nu_t_(i, j, k);
    }
    const Real v = y(i, j, k);
    sums[PlaneSums::vv] += v * v;
    sums[PlaneSums::uv] += Real(0.25) * (y(i - 1, j, k) + v) * (x(i, j - 1, k) + x(i, j, k));
    sums[PlaneSums::viscous] +=
        stress_.nu * (x(i, j, k) - x(i, j - 1, k)) * (1 / grid.dy_centre(j));
    sums[PlaneSums::stress] += stress_.xy(i, j, k);
  }
};

/// Adds one instant: a team per row.
struct AddPlaneMeans {
  PlaneSample sample;
  Kokkos::View<PlaneSums*> sums;  // (ny + 1)

  using Team = Kokkos::TeamPolicy<>::member_type;
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int j = team.league_rank(), nx = sample.grid.nx;
    PlaneSums row;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, nx * sample.grid.nz),
        [&](int n, PlaneSums& part) { sample.add(n % nx, j, n / nx, part); },
        Kokkos::Sum<PlaneSums>(row));
    Kokkos::single(Kokkos::PerTeam(team), [&] { sums(j) += row; });
  }
};

}  // namespace barchan

template <>
struct Kokkos::reduction_identity<barchan::PlaneSums> {
  KOKKOS_FORCEINLINE_FUNCTION static barchan::PlaneSums sum() { return {}; }
};
