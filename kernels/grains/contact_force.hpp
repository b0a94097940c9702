// Force and torque of one contact with tangential history. The same law serves grain-grain and
// grain-wall; it has no branches that a compiler cannot turn into selects, so that a block of
// contacts vectorises.
#pragma once

#include "kernels/grains/contact_law.hpp"

namespace barchan {

/// Geometry and relative motion of a touching pair (i, j); for a wall j stands still.
struct ContactPair {
  Vec3 normal;           // unit, from j to i
  Real delta_n;          // overlap, A1, > 0 [m]
  Vec3 slip;             // velocity of i relative to j at the contact point [m/s]
  Vec3 spin_difference;  // omega_i - omega_j [rad/s]
  Real r_eff, m_eff;     // A2 [m], A3 [kg]
};

/// What a contact does to grain i; j gets -force, the same arm torque and -rolling torque.
struct ContactResult {
  Vec3 force;        // normal + tangential, on i [N]
  Vec3 n_cross_f_t;  // n x F_t [N]; torque on either grain = -(lever arm) n_cross_f_t
  Vec3 xi_t;         // tangential displacement after the step [m]
  Vec3 rolling;      // rolling torque on i [N m]
};

/// Friction of a pair of materials.
struct Friction {
  Real sliding = 0;           // mu
  Real rolling = 0;           // mu_r
  Real dashpot_in_limit = 1;  // share of the normal dashpot in F_c: 1 total force, 0 elastic part
};

/// Slip velocity at the contact point: lever arms r - delta_n / 2 on both sides [m/s].
KOKKOS_FORCEINLINE_FUNCTION Vec3 contact_slip(const Vec3& velocity_difference,
                                              const Vec3& arm_spin_sum, const Vec3& normal) {
  return velocity_difference - cross(arm_spin_sum, normal);
}

/// Contact force, Lima et al. (2022) eqs 8-10 with A6-A13 as the programs behind the paper
/// evaluate them (docs/model.md):
///   F_n = k_n delta_n - gamma_n v_n                     (attractive tail kept)
///   xi_t <- tangent-plane part of (xi_t + v_t dt)
///   |k_t xi_t| <= mu F_c:  F_t = -k_t xi_t - gamma_t v_t, shortened to mu F_c where it is longer
///   else                   F_t = -mu F_c xi_t/|xi_t|, xi_t shortened to the limit (re-sticks)
/// F_c = |F_n|, or k_n delta_n in the Coulomb limit of Chung & Ooi (2011).
/// `history` is the result of the previous sub-step (zero at first touch); dt [s].
template <class Stiffness, class Rolling>
KOKKOS_FORCEINLINE_FUNCTION ContactResult contact_force(const Stiffness& law,
                                                        const Rolling& rolling,
                                                        const Friction& friction,
                                                        const ContactPair& pair,
                                                        const ContactResult& history, Real dt) {
  const ContactStiffness k = law(pair.r_eff, pair.m_eff, pair.delta_n);
  const Real v_n = dot(pair.slip, pair.normal);
  const Vec3 v_t = fused(-v_n, pair.normal, pair.slip);
  const Real elastic = k.k_n * pair.delta_n, dashpot = -k.gamma_n * v_n;
  const Real f_n = elastic + dashpot;

  Vec3 xi = fused(dt, v_t, history.xi_t);
  xi = fused(-dot(xi, pair.normal), pair.normal, xi);
  const Vec3 spring = (-k.k_t) * xi;
  const Real limit = friction.sliding * Kokkos::abs(elastic + friction.dashpot_in_limit * dashpot);
  const bool slides = dot(spring, spring) > limit * limit;
  const Vec3 trial = fused(slides ? Real(0) : -k.gamma_t, v_t, spring);
  const Real size2 = dot(trial, trial);  // that of the spring where it slides
  const Real shorten = size2 > limit * limit ? limit / Kokkos::sqrt(size2) : Real(1);
  const Vec3 f_t = shorten * trial;
  xi = (slides ? shorten : Real(1)) * xi;

  ContactResult result;
  result.force = fused(f_n, pair.normal, f_t);
  result.n_cross_f_t = cross(pair.normal, f_t);
  result.xi_t = xi;
  result.rolling = rolling(RollingContact{.normal = pair.normal,
                                          .spin_difference = pair.spin_difference,
                                          .r_eff = pair.r_eff,
                                          .k_t = k.k_t,
                                          .f_n = Kokkos::abs(f_n),
                                          .mu_r = friction.rolling,
                                          .dt = dt},
                           history.rolling);
  return result;
}

}  // namespace barchan
