// Rolling resistance: the torque that opposes relative rolling at a contact.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// What a rolling law sees of one contact.
struct RollingContact {
  Vec3 normal;           // unit, from j to i
  Vec3 spin_difference;  // omega_i - omega_j [rad/s]
  Real r_eff;            // [m]
  Real k_t;              // tangential stiffness now [N/m]
  Real f_n;              // |normal force| [N]
  Real mu_r;             // rolling friction [-]
  Real dt;               // sub-step [s]
};

/// Relative spin without its part along the normal (no torsion) [rad/s].
KOKKOS_FORCEINLINE_FUNCTION Vec3 rolling_spin(const RollingContact& c) {
  return fused(-dot(c.spin_difference, c.normal), c.normal, c.spin_difference);
}

/// `torque` after a rotation by -k_r w_t dt, its magnitude limited to mu_r R_eff F_n.
KOKKOS_FORCEINLINE_FUNCTION Vec3 limited_rolling_spring(const RollingContact& c, Real k_r,
                                                        const Vec3& torque) {
  const Vec3 trial = fused(-k_r * c.dt, rolling_spin(c), torque);
  const Real size = norm(trial);
  const Real limit = c.mu_r * c.r_eff * c.f_n;
  return (size > limit ? limit / size : Real(1)) * trial;
}

/// No rolling resistance.
struct NoRolling {
  static constexpr bool has_history = false;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact&, const Vec3&) const {
    return {};
  }
};

/// EPSD2: k_r = k_t R_eff^2, no dashpot (Ai et al. 2011 with the stiffness of Iwashita & Oda 1998;
/// the model the paper's programs evaluate). Torque on i [N m].
struct Epsd2 {
  static constexpr bool has_history = true;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3& torque) const {
    return limited_rolling_spring(c, c.k_t * c.r_eff * c.r_eff, torque);
  }
};

/// The paper's A12-A13 (Derakhshani et al. 2015): k_r = mu_r R_eff F_n / theta_m, which reaches the
/// limit mu_r R_eff F_n when the contact has rolled by theta_m [rad].
struct ThetaM {
  static constexpr bool has_history = true;
  Real theta_m = Real(0.1);
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3& torque) const {
    return limited_rolling_spring(c, c.mu_r * c.r_eff * c.f_n / theta_m, torque);
  }
};

/// Constant directional torque mu_r R_eff F_n against the relative rolling (Ai et al. 2011, model
/// A).
struct ConstantTorque {
  static constexpr bool has_history = false;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3&) const {
    const Vec3 spin = rolling_spin(c);
    const Real size = norm(spin);
    return (size > 0 ? -c.mu_r * c.r_eff * c.f_n / size : Real(0)) * spin;
  }
};

}  // namespace barchan
