// Viscosity that a moving grain adds to the fluid that its rows share. Equations:
// docs/theory-coupling.md, "Viscosity of the mixture".
#pragma once

#include "kernels/coupling/grain_rows.hpp"
#include "kernels/grains/grain.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

inline constexpr Real kDensestFlow = 0.585, kMostMixed = 0.565;

/// (eta - 1)/phi of the relative viscosity eta of a suspension with the solid fraction phi, without
/// contacts: Boyer, Guazzelli & Pouliquen, Phys. Rev. Lett. 107, 188301 (2011),
///   eta = 1 + 5/2 phi / (1 - phi/0.585).
/// It is 5/2 at phi = 0 (Einstein 1906), and 73 at the largest phi that counts, 0.565.
KOKKOS_INLINE_FUNCTION Real viscosity_of_grains(Real phi) {
  return Real(2.5) / (1 - Kokkos::min(phi, Real(kMostMixed)) / kDensestFlow);
}

/// Rate [kg/s] at which a grain joins the rows that it lies in. The forces rate w_j (u_j - u_f) act
/// in the middles of the rows; their moment is mu_f V_p (eta - 1)/phi times the shear: the
/// stresslet of a sphere that follows its fluid.
struct Stresslet {
  Real mu_f = 0;  // [Pa s]; 0: none
  // Lower bound, over r, of the distance between the mean heights of the parts of a grain in two
  // rows.
  static constexpr Real kClosest = 0.5;

  /// Rate of the grain, at least `beta`, the rate of its drag. A grain at rest or in one row has
  /// `beta` alone. A grain that lags behind its fluid by `slip` counts by u_p^2/(u_p^2 + slip^2).
  KOKKOS_INLINE_FUNCTION Real operator()(const GridRef& grid, const GrainRows& rows,
                                         const GrainKinematics& grain, const Vec3& slip, Real phi,
                                         Real beta) const {
    const Real moving = grain.u.x * grain.u.x + grain.u.z * grain.u.z;
    if (mu_f == 0 || rows.n < 2 || moving == 0) return beta;
    Real mean_height = 0, mean_middle = 0, mean_product = 0;
    for (int q = 0; q < rows.n; ++q) {
      const Real height = rows.height(grid, q) - grain.x.y, w = rows.weight(q);
      const Real middle = grid.y_centre(rows.row[q]) - grain.x.y;
      mean_height += w * height, mean_middle += w * middle;
      mean_product += w * height * middle;
    }
    const Real of_mixture = mu_f * sphere_volume(grain.r) * viscosity_of_grains(phi) /
                            (mean_product - mean_height * mean_middle);
    const Real lag = slip.x * slip.x + slip.z * slip.z;
    return beta + Kokkos::max(of_mixture - beta, Real(0)) * moving / (moving + lag);
  }
  /// Upper bound [kg/s] of rate times w (1 - w), for two rows.
  KOKKOS_FORCEINLINE_FUNCTION Real most(Real r) const {
    return mu_f * sphere_volume(r) * viscosity_of_grains(kMostMixed) /
           (kClosest * r * kClosest * r);
  }
};

}  // namespace barchan
