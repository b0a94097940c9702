// Contact law: stiffness and damping, Hertz-Mindlin and linear spring-dashpot, and the film of
// water before a contact; force and torque of one contact with tangential history. Contacts of
// grains with grains and with walls have the same law. It has no branches that a compiler cannot
// turn into selects, so that a block of contacts vectorises.
// Equation numbers: Lima et al. (2022), appendix A, with the misprints put right
// (docs/barchan-10k.md). Laws of one kind are small types with the same call.
#pragma once

#include <numbers>

#include "kernels/grains/rolling_law.hpp"

namespace barchan {

/// Elastic constants of one material.
struct Elastic {
  Real youngs_modulus = 0;  // [Pa]
  Real poisson_ratio = 0;   // [-]
};

/// Contact modulus E_eff of two materials, A4 [Pa].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real effective_youngs_modulus(const Elastic& a,
                                                                    const Elastic& b) {
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

/// Contact shear modulus G_eff of two materials, A5 [Pa].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real effective_shear_modulus(const Elastic& a,
                                                                   const Elastic& b) {
  return 1 / (2 * (2 - a.poisson_ratio) * (1 + a.poisson_ratio) / a.youngs_modulus +
              2 * (2 - b.poisson_ratio) * (1 + b.poisson_ratio) / b.youngs_modulus);
}

/// Damping ratio that delivers the restitution e, A8 with its sign turned: in [0, 1], 0 at e = 1.
KOKKOS_FORCEINLINE_FUNCTION Real damping_ratio(Real restitution) {
  const Real log_e = Kokkos::log(restitution);
  return -log_e / Kokkos::sqrt(log_e * log_e + std::numbers::pi_v<Real> * std::numbers::pi_v<Real>);
}

/// Material constants that set the force between two surfaces.
struct ContactMaterial {
  Elastic a, b;
  Real restitution = 1;
  Real linear_stiffness = 0;    // [N/m]
  Real tangential_damping = 1;  // factor on the tangential dashpot
  Real film_viscosity = 0;      // of the water between the surfaces [Pa s]
  Real film_reach = 0;          // gap below which the flow does not resolve it [m]
  Real thinnest_film = 1;       // over the effective radius
};

/// Elastic normal force, tangential spring and dashpots of one contact.
struct ContactStiffness {
  Real elastic;           // [N]; negative: attraction
  Real k_t;               // [N/m]
  Real gamma_n, gamma_t;  // [kg/s], >= 0
};

/// Largest distance of two surfaces in contact [m]: 0, unless the law has a reach of its own
/// because it attracts.
template <class Law>
KOKKOS_FORCEINLINE_FUNCTION constexpr Real reach(const Law& law, Real r_eff) {
  if constexpr (requires { law.reach(r_eff); }) {
    return law.reach(r_eff);
  } else {
    return 0;
  }
}
template <class Law>
KOKKOS_FORCEINLINE_FUNCTION constexpr bool in_contact(const Law& law, Real r_eff, Real delta_n) {
  return delta_n > -reach(law, r_eff);
}

/// Hertz normal spring (A6), Mindlin tangential spring (A7), damping of Tsuji et al. (1992) in the
/// form of Antypov & Elliott (2011), which returns e exactly when the attractive tail is kept
/// (A9, A10). r_eff, delta_n [m]; m_eff [kg]. Limits: no force as delta_n -> 0; e = 1: no damping.
struct HertzMindlin {
  static constexpr Named named{"hertz_mindlin",
                               "Hertz (1881), Mindlin (1949), Tsuji et al. (1992)"};
  Real e_eff = 0, g_eff = 0;        // [Pa]
  Real damping = 0, damping_t = 0;  // damping_ratio(e); that of the tangential dashpot

  static HertzMindlin from(const ContactMaterial& m) {
    const Real ratio = damping_ratio(m.restitution);
    return {.e_eff = effective_youngs_modulus(m.a, m.b),
            .g_eff = effective_shear_modulus(m.a, m.b),
            .damping = ratio,
            .damping_t = m.tangential_damping * ratio};
  }
  KOKKOS_FORCEINLINE_FUNCTION ContactStiffness operator()(Real r_eff, Real m_eff,
                                                          Real delta_n) const {
    const Real a = Kokkos::sqrt(r_eff * delta_n);  // radius of the contact area [m]
    const Real root = Kokkos::sqrt(a * m_eff);
    const Real two_root_5_6 = Real(1.8257418583505537);  // 2 sqrt(5/6)
    return {.elastic = Real(4) / 3 * e_eff * a * delta_n,
            .k_t = 8 * g_eff * a,
            .gamma_n = two_root_5_6 * damping * Kokkos::sqrt(2 * e_eff) * root,
            .gamma_t = two_root_5_6 * damping_t * Kokkos::sqrt(8 * g_eff) * root};
  }
};

/// Linear spring-dashpot: constant k_n, k_t = 2/7 k_n, the damping of the same restitution,
/// gamma = 2 damping sqrt(m_eff k) (Schaefer, Dippel & Wolf 1996).
struct LinearSpring {
  static constexpr Named named{"linear", "springs of `linear_stiffness`, Schaefer et al. (1996)"};
  Real k_n = 0;                     // [N/m]
  Real damping = 0, damping_t = 0;  // as in HertzMindlin

  static LinearSpring from(const ContactMaterial& m) {
    const Real ratio = damping_ratio(m.restitution);
    return {.k_n = m.linear_stiffness, .damping = ratio, .damping_t = m.tangential_damping * ratio};
  }
  KOKKOS_FORCEINLINE_FUNCTION ContactStiffness operator()(Real, Real m_eff, Real delta_n) const {
    const Real k_t = Real(2) / 7 * k_n;
    return {.elastic = k_n * delta_n,
            .k_t = k_t,
            .gamma_n = 2 * damping * Kokkos::sqrt(m_eff * k_n),
            .gamma_t = 2 * damping_t * Kokkos::sqrt(m_eff * k_t)};
  }
};

/// Damping of the film between two surfaces that approach, 6 pi mu R_eff^2 / gap [kg/s]: leading
/// term of Cox & Brenner (1967), for spheres and for a sphere and a plane.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real film_damping(Real viscosity, Real r_eff, Real gap) {
  return 6 * std::numbers::pi_v<Real> * viscosity * r_eff * r_eff / gap;
}

/// Hertz-Mindlin contacts, and before them the part of the film's force that the cells of a
/// resolved flow are too wide for: that at the gap less that at its reach. Below the thinnest film
/// the force stays (Biegert et al. 2017). Limits: no viscosity, or a gap beyond the reach:
/// HertzMindlin.
struct HertzLubricated {
  static constexpr Named named{"hertz_lubricated",
                               "hertz_mindlin, and the film before contact, Cox & Brenner (1967)"};
  static constexpr bool acts_apart = true;
  HertzMindlin contact{};
  Real viscosity = 0, film = 0, thinnest = 1;  // as in ContactMaterial

  static HertzLubricated from(const ContactMaterial& m) {
    return {.contact = HertzMindlin::from(m),
            .viscosity = m.film_viscosity,
            .film = m.film_reach,
            .thinnest = m.thinnest_film};
  }
  KOKKOS_FORCEINLINE_FUNCTION constexpr Real reach(Real) const { return film; }
  KOKKOS_FORCEINLINE_FUNCTION ContactStiffness operator()(Real r_eff, Real m_eff,
                                                          Real delta_n) const {
    ContactStiffness k = contact(r_eff, m_eff, Kokkos::max(delta_n, Real(0)));
    const Real gap = Kokkos::max(-delta_n, thinnest * r_eff);
    const Real more = film_damping(viscosity, r_eff, Kokkos::min(gap, film)) -
                      film_damping(viscosity, r_eff, film);
    k.gamma_n += delta_n > 0 || film == 0 ? Real(0) : more;
    return k;
  }
};

using ContactModels = Alternatives<HertzMindlin, LinearSpring, HertzLubricated>;

/// Tells if a law acts between surfaces that do not touch: then they have no friction and no
/// history.
template <class Law>
KOKKOS_FORCEINLINE_FUNCTION constexpr bool acts_apart() {
  if constexpr (requires { Law::acts_apart; }) return Law::acts_apart;
  return false;
}

/// Geometry and relative motion of a touching pair (i, j); for a wall j stands still.
struct ContactPair {
  Vec3 normal;            // unit, from j to i
  Real delta_n;           // overlap, A1 [m]
  Vec3 slip;              // velocity of i relative to j at the contact point [m/s]
  Vec3 omega_difference;  // omega_i - omega_j [rad/s]
  Real r_eff, m_eff;      // A2 [m], A3 [kg]
};

/// Effect of a contact on grain i; j gets -force, the same arm torque and -rolling torque.
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
                                              const Vec3& arm_omega_sum, const Vec3& normal) {
  return velocity_difference - cross(arm_omega_sum, normal);
}

/// Contact force, Lima et al. (2022) eqs 8-10 with A6-A13 as the programs behind the paper
/// evaluate them (docs/theory-grains.md):
///   F_n = elastic - gamma_n v_n                         (attractive tail kept)
///   xi_t <- tangent-plane part of (xi_t + v_t dt)
///   |k_t xi_t| <= mu F_c:  F_t = -k_t xi_t - gamma_t v_t, shortened to mu F_c where it is longer
///   else                   F_t = -mu F_c xi_t/|xi_t|, xi_t shortened to the limit (re-sticks)
/// F_c = |F_n|, or the elastic force in the Coulomb limit of Chung & Ooi (2011).
/// `history` is the result of the previous grain step (zero at first touch); dt [s].
template <class Rolling>
KOKKOS_FORCEINLINE_FUNCTION ContactResult contact_force(const ContactStiffness& k,
                                                        const Rolling& rolling,
                                                        const Friction& friction,
                                                        const ContactPair& pair,
                                                        const ContactResult& history, Real dt) {
  const Real v_n = dot(pair.slip, pair.normal);
  const Vec3 v_t = fma(-v_n, pair.normal, pair.slip);
  const Real elastic = k.elastic, dashpot = -k.gamma_n * v_n;
  const Real f_n = elastic + dashpot;

  Vec3 xi = fma(dt, v_t, history.xi_t);
  xi = fma(-dot(xi, pair.normal), pair.normal, xi);
  const Vec3 spring = (-k.k_t) * xi;
  const Real limit = friction.sliding * Kokkos::abs(elastic + friction.dashpot_in_limit * dashpot);
  const bool slides = dot(spring, spring) > limit * limit;
  const Vec3 trial = fma(slides ? Real(0) : -k.gamma_t, v_t, spring);
  const Real size2 = dot(trial, trial);  // square of the spring's length where it slides
  const Real shorten = size2 > limit * limit ? limit / Kokkos::sqrt(size2) : Real(1);
  const Vec3 f_t = shorten * trial;
  xi = (slides ? shorten : Real(1)) * xi;

  ContactResult result;
  result.force = fma(f_n, pair.normal, f_t);
  result.n_cross_f_t = cross(pair.normal, f_t);
  result.xi_t = xi;
  result.rolling = rolling(RollingContact{.normal = pair.normal,
                                          .omega_difference = pair.omega_difference,
                                          .r_eff = pair.r_eff,
                                          .k_t = k.k_t,
                                          .f_n = Kokkos::abs(f_n),
                                          .mu_r = friction.rolling,
                                          .dt = dt},
                           history.rolling);
  return result;
}

}  // namespace barchan
