// Forces of shear and a floor on one grain beyond the drag laws: lift, the floor's part of the
// drag, torque. All are those of a lone sphere in the undisturbed flow at its centre. Sources and
// ranges: docs/theory-coupling.md, "Lift, torque, wall drag".
#pragma once

#include "kernels/coupling/drag.hpp"

namespace barchan {

/// The sheared flow that a lone grain sees.
struct LocalShear {
  Real rho_f = 0, mu_f = 0;  // [kg/m^3], [Pa s]
  Real d_p = 0;              // [m]
  Real slip = 0;             // |u_f - u_p| [m/s]
  Real vorticity = 0;        // |curl u_f| [1/s]
  Real gap = 0;              // between the grain and the no-slip floor [m]
};

/// Saffman (1965, 1968) times the correction of Mei (1992): F = k (u_f - u_p) x w/|w| with
///   k = 1.615 rho d^2 sqrt(nu |w|) f                                                [kg/s]
///   f = (1 - 0.3314 sqrt(b)) exp(-Re/10) + 0.3314 sqrt(b)    Re <= 40
///       0.0524 sqrt(b Re)                                    Re > 40
/// b = |w| d/(2 slip), Re = slip d/nu; fitted for 0.1 <= Re <= 100 and 0.005 <= b <= 0.4, so a
/// larger b counts as 0.4. Far from walls. Limit: f = 1 at Re = 0.
KOKKOS_INLINE_FUNCTION Real saffman_mei_factor(Real reynolds, Real b) {
  const Real root = Real(0.3314) * Kokkos::sqrt(b);
  return reynolds <= 40 ? (1 - root) * Kokkos::exp(-reynolds / 10) + root
                        : Real(0.0524) * Kokkos::sqrt(b * reynolds);
}
KOKKOS_INLINE_FUNCTION Real saffman_mei(const LocalShear& s) {
  const Real reynolds = s.rho_f * s.slip * s.d_p / s.mu_f;
  const Real twice_slip = 2 * s.slip, w_d = s.vorticity * s.d_p;
  const Real b = w_d < Real(0.4) * twice_slip ? w_d / twice_slip : Real(0.4);
  return Real(1.615) * s.d_p * s.d_p * Kokkos::sqrt(s.rho_f * s.mu_f * s.vorticity) *
         saffman_mei_factor(reynolds, b);
}

/// Lift coefficient of a sphere held in linear shear over a floor, F = (pi/8) C_l rho d^2 slip^2
/// away from it; Zeng, Najjar, Balachandar & Fischer (2009), eq. 19, 28, 29. Re = slip d/nu;
/// `delta` = gap/d. For 1 < Re < 200; a larger Re counts as 200. Limit: 5.87 of Leighton & Acrivos
/// (1985) for Re = 0 at the floor.
KOKKOS_INLINE_FUNCTION Real floor_lift_coefficient(Real reynolds, Real delta) {
  const Real re = reynolds < 200 ? reynolds : Real(200);
  const Real at_floor = Real(3.663) / Kokkos::pow(re * re + Real(0.1173), Real(0.22));
  const Real a = -Kokkos::exp(Real(-0.3) + Real(0.025) * re), b = Real(0.8) + Real(0.01) * re;
  const Real lambda = (1 - Kokkos::exp(-delta)) * Kokkos::pow(re / 250, Real(2.5));
  return at_floor * Kokkos::exp(-delta / 2 * Kokkos::pow(re / 250, Real(4) / 3)) *
         (Kokkos::exp(a * Kokkos::pow(delta, b)) - lambda);
}

/// Gaps over d between which lift changes from the floor's correlation to Saffman-Mei: the former
/// takes the flow for a linear profile above the floor. Our choice.
inline constexpr Real kFloorLiftWhole = 0.5, kFloorLiftNone = 1;

/// k [kg/s] of the lift F = k (u_f - u_p) x w/|w|.
KOKKOS_INLINE_FUNCTION Real lift_coefficient(const LocalShear& s) {
  const Real delta = s.gap / s.d_p;
  const Real floor = Kokkos::clamp((kFloorLiftNone - delta) / (kFloorLiftNone - kFloorLiftWhole),
                                   Real(0), Real(1));
  Real k = floor < 1 ? (1 - floor) * saffman_mei(s) : 0;
  if (floor > 0) {
    const Real c_l = floor_lift_coefficient(s.rho_f * s.slip * s.d_p / s.mu_f, delta);
    k += floor * c_l * std::numbers::pi_v<Real> / 8 * s.rho_f * s.d_p * s.d_p * s.slip;
  }
  return k;
}

/// Drag of a sphere held in linear shear over a floor, over that of Schiller & Naumann at the same
/// velocity; Zeng et al. (2009), eq. 13, 14. `delta` = gap/d; for Re = slip d/nu up to 200, a
/// larger one counts as 200. Limits for Re = 0: 1.7005 at the floor (Goldman, Cox & Brenner 1967;
/// O'Neill 1968: 1.7009), 1 + (9/16) (d/2)/y far away (Faxen); 1 at infinity.
KOKKOS_INLINE_FUNCTION Real floor_drag_factor(Real reynolds, Real delta) {
  const Real re = reynolds < 200 ? reynolds : Real(200);
  const Real near = Real(0.16) * delta * delta, nearer = Real(0.76) * delta * delta;
  const Real a = Real(0.15) - Real(0.046) * (1 - near) * Kokkos::exp(Real(-0.7) * delta);
  const Real b =
      Real(0.687) + Real(0.066) * (1 - nearer) * Kokkos::exp(-Kokkos::pow(delta, Real(0.9)));
  const Real creeping =
      1 + Real(0.138) * Kokkos::exp(-2 * delta) + Real(9) / (16 * (1 + 2 * delta));
  return creeping * (1 + a * Kokkos::pow(re, b)) / (1 + Real(0.15) * Kokkos::pow(re, Real(0.687)));
}

/// Floor drag factor in a flow as the drag laws see it, at the gap [m]; a grain pressed into the
/// floor counts as on it.
KOKKOS_INLINE_FUNCTION Real floor_drag_factor(const LocalFlow& f, Real gap) {
  return floor_drag_factor(reynolds_number(f, 1, f.d_p), gap > 0 ? gap / f.d_p : Real(0));
}

/// Resistance of a sphere that turns at `spin` = |curl u_f/2 - omega| relative to the fluid:
/// T = beta_r (curl u_f/2 - omega), beta_r = pi mu d^3 (Kirchhoff; Rubinow & Keller 1961) times
/// (12.9 sqrt(Re_r) + 128.4)/(64 pi) above Re_r = d^2 spin/nu = 32 (Dennis, Singh & Ingham 1980,
/// as C_r = 12.9/sqrt(Re_r) + 128.4/Re_r; to Re_r = 1000) [N m s].
KOKKOS_INLINE_FUNCTION Real rotational_drag(Real rho_f, Real mu_f, Real d, Real spin) {
  const Real pi = std::numbers::pi_v<Real>;
  const Real reynolds = rho_f * d * d * spin / mu_f;
  const Real factor = (Real(12.9) * Kokkos::sqrt(reynolds) + Real(128.4)) / (64 * pi);
  return pi * mu_f * d * d * d * (factor > 1 ? factor : 1);
}

/// Factor 1/alpha on the torque among neighbours that leave the fluid fraction alpha; fitted to
/// grains at the surface of resolved beds (docs/validation.md, "Forces at the surface of a bed").
KOKKOS_INLINE_FUNCTION Real torque_among_grains(Real alpha) { return 1 / alpha; }

}  // namespace barchan
