// Rolling laws: the torque that opposes relative rolling of two surfaces in contact.
// Laws of one kind are small types with the same call.
#pragma once

#include "kernels/math/alternatives.hpp"
#include "kernels/math/vec3.hpp"

namespace barchan {

/// State of one contact as a rolling law needs it.
struct RollingContact {
  Vec3 normal;            // unit, from j to i
  Vec3 omega_difference;  // omega_i - omega_j [rad/s]
  Real r_eff;             // [m]
  Real k_t;               // tangential stiffness now [N/m]
  Real f_n;               // |normal force| [N]
  Real mu_r;              // rolling friction [-]
  Real dt;                // grain step [s]
};

/// Relative spin without its part along the normal (no torsion) [rad/s].
KOKKOS_FORCEINLINE_FUNCTION Vec3 rolling_velocity(const RollingContact& c) {
  return fma(-dot(c.omega_difference, c.normal), c.normal, c.omega_difference);
}

/// Rolling torque `torque` after a rotation by -k_r w_t dt, its magnitude limited to mu_r R_eff
/// F_n.
KOKKOS_FORCEINLINE_FUNCTION Vec3 limited_rolling_spring(const RollingContact& c, Real k_r,
                                                        const Vec3& torque) {
  const Vec3 trial = fma(-k_r * c.dt, rolling_velocity(c), torque);
  const Real size = norm(trial);
  const Real limit = c.mu_r * c.r_eff * c.f_n;
  return (size > limit ? limit / size : Real(1)) * trial;
}

/// No rolling resistance.
struct NoRolling {
  static constexpr Named named{"none", "no resistance"};
  static constexpr bool has_history = false;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact&, const Vec3&) const {
    return {};
  }
};

/// EPSD2: k_r = k_t R_eff^2, no dashpot (Ai et al. 2011 with the stiffness of Iwashita & Oda 1998;
/// the model the paper's programs evaluate). Torque on i [N m].
struct Epsd2 {
  static constexpr Named named{
      "epsd2", "a spring of k_t R^2, Ai et al. (2011), as in the programs behind the paper"};
  static constexpr bool has_history = true;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3& torque) const {
    return limited_rolling_spring(c, c.k_t * c.r_eff * c.r_eff, torque);
  }
};

/// The paper's A12-A13 (Derakhshani et al. 2015): k_r = mu_r R_eff F_n / theta_m, which reaches the
/// limit mu_r R_eff F_n when the contact has rolled by theta_m [rad].
struct ThetaM {
  static constexpr Named named{
      "theta_m", "a spring that slips at `rolling_theta_m`, Derakhshani et al. (2015)"};
  static constexpr bool has_history = true;
  Real theta_m = Real(0.1);
  static ThetaM from(Real theta_m) { return {.theta_m = theta_m}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3& torque) const {
    return limited_rolling_spring(c, c.mu_r * c.r_eff * c.f_n / theta_m, torque);
  }
};

/// Constant directional torque mu_r R_eff F_n against the relative rolling (Ai et al. 2011, model
/// A).
struct ConstantTorque {
  static constexpr Named named{"cdt", "a constant torque, Ai et al. (2011)"};
  static constexpr bool has_history = false;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const RollingContact& c, const Vec3&) const {
    const Vec3 spin = rolling_velocity(c);
    const Real size = norm(spin);
    return (size > 0 ? -c.mu_r * c.r_eff * c.f_n / size : Real(0)) * spin;
  }
};

using RollingModels = Alternatives<NoRolling, Epsd2, ThetaM, ConstantTorque>;

}  // namespace barchan
