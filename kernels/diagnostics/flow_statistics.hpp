// Sums for turbulence statistics: over time in every cell, and over planes of constant height.
#pragma once

#include "kernels/fluid/momentum.hpp"

namespace barchan {

/// Quantities summed at the cell centres; velocities there are means of the two faces [m/s].
enum FlowMoment : int {
  mean_u,
  mean_v,
  mean_w,
  mean_p,
  mean_alpha_f,
  mean_nu_t,
  moment_uu,
  moment_vv,
  moment_ww,
  moment_uv,
  moment_uw,
  moment_vw,
  n_flow_moments
};

using FlowSums = Kokkos::Array<FieldRef, n_flow_moments>;

/// Adds one instant to the sums in cells. Products are of deviations from the flow at the first
/// sample, so that a long mean does not drown small fluctuations.
struct AddFlowMoments {
  ConstFaceRef u;
  ConstFieldRef p, alpha_f, nu_t;
  FlowSums sum;
  ConstFieldRef first_u, first_v, first_w;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const Vec3 now = velocity_at_cell(u, i, j, k);
    const Real a = now.x - first_u(i, j, k), b = now.y - first_v(i, j, k),
               c = now.z - first_w(i, j, k);
    const Real value[n_flow_moments] = {
        a,     b,     c,     p(i, j, k), alpha_f(i, j, k), nu_t(i, j, k), a * a, b * b,
        c * c, a * b, a * c, b * c};
    for (int q = 0; q < n_flow_moments; ++q) sum[q](i, j, k) += value[q];
  }
};

/// Means from the sums, and central second moments <a'b'> = <ab> - <a><b>, both to `result`.
struct FlowMeans {
  FlowSums sum, result;
  ConstFieldRef first_u, first_v, first_w;
  Real per_sample = 0;  // 1 / number of samples

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    Real m[n_flow_moments];
    for (int q = 0; q < n_flow_moments; ++q) m[q] = per_sample * sum[q](i, j, k);
    const Real a = m[mean_u], b = m[mean_v], c = m[mean_w];
    const Real value[n_flow_moments] = {
        first_u(i, j, k) + a, first_v(i, j, k) + b, first_w(i, j, k) + c, m[mean_p],
        m[mean_alpha_f],      m[mean_nu_t],         m[moment_uu] - a * a, m[moment_vv] - b * b,
        m[moment_ww] - c * c, m[moment_uv] - a * b, m[moment_uw] - a * c, m[moment_vw] - b * c};
    for (int q = 0; q < n_flow_moments; ++q) result[q](i, j, k) = value[q];
  }
};

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

/// Adds one instant to the sums over planes, a team per row. j = ny is the top boundary: its faces
/// count, its cells do not.
struct AddPlaneMeans {
  GridRef grid;
  ConstFaceRef u;
  ConstFieldRef p, nu_t;
  StressDivergence stress;
  Kokkos::View<PlaneSums*> sums;  // (ny + 1)

  KOKKOS_FORCEINLINE_FUNCTION void add(int i, int j, int k, PlaneSums& to) const {
    const ConstFieldRef &x = u.x, &y = u.y;
    if (j < grid.ny) {
      const Real z = u.z(i, j, k);
      to[PlaneSums::u] += x(i, j, k);
      to[PlaneSums::w] += z;
      to[PlaneSums::uu] += x(i, j, k) * x(i, j, k);
      to[PlaneSums::ww] += z * z;
      to[PlaneSums::p] += p(i, j, k);
      to[PlaneSums::nu_t] += nu_t(i, j, k);
    }
    const Real v = y(i, j, k);
    to[PlaneSums::vv] += v * v;
    to[PlaneSums::uv] += Real(0.25) * (y(i - 1, j, k) + v) * (x(i, j - 1, k) + x(i, j, k));
    to[PlaneSums::viscous] += stress.nu * (x(i, j, k) - x(i, j - 1, k)) * (1 / grid.dy_centre(j));
    to[PlaneSums::stress] += stress.xy(i, j, k);
  }

  using Team = Kokkos::TeamPolicy<>::member_type;
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int j = team.league_rank();
    PlaneSums row;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, grid.nx * grid.nz),
        [&](int n, PlaneSums& part) { add(n % grid.nx, j, n / grid.nx, part); },
        Kokkos::Sum<PlaneSums>(row));
    Kokkos::single(Kokkos::PerTeam(team), [&] { sums(j) += row; });
  }
};

}  // namespace barchan

template <>
struct Kokkos::reduction_identity<barchan::PlaneSums> {
  KOKKOS_FORCEINLINE_FUNCTION static barchan::PlaneSums sum() { return {}; }
};
