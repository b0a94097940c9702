// Sums over time of the flow and its products in every cell, for averages on the grid.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// What is summed at the cell centres; velocities there are means of the two faces [m/s].
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

/// Adds one instant. Products are of deviations from the flow at the first sample, so that a long
/// mean does not drown small fluctuations.
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

/// Writes it for all cells.
struct CentreVelocity {
  ConstFaceRef u;
  FieldRef x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const Vec3 now = velocity_at_cell(u, i, j, k);
    x(i, j, k) = now.x, y(i, j, k) = now.y, z(i, j, k) = now.z;
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

}  // namespace barchan
