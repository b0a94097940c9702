// Flat walls: the contact law with one side at rest and flat (r_eff = r, m_eff = m).
#pragma once

#include <cstdint>

#include "kernels/contact_force.hpp"
#include "kernels/grain.hpp"

namespace barchan {

/// Wall with unit normal into the domain; signed distance of x = normal . x - offset [m].
struct Plane {
  Vec3 normal;
  Real offset = 0;
};

inline constexpr int kMaxWalls = 6;

/// The walls, their material and every grain's history with each of them.
template <class Stiffness, class Rolling>
struct Walls {
  int n = 0;
  Plane plane[kMaxWalls];
  Stiffness law;
  Rolling rolling;
  Friction friction;
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> xi_t, torque;  // (grain, wall): [m], [N m]
  Kokkos::View<std::uint8_t*> touching;                   // bit w: grain touches wall w

  /// Adds the force [N] and torque [N m] of all walls on grain g; advances the history by dt.
  /// Returns the largest overlap [m].
  KOKKOS_FUNCTION Real add(int g, const GrainKinematics& grain, Real dt, Vec3& force,
                           Vec3& torque_sum) const {
    Real largest = 0;
    for (int w = 0; w < n; ++w) {
      const std::uint8_t bit = static_cast<std::uint8_t>(1u << w);
      const Vec3& normal = plane[w].normal;
      const Real delta_n = grain.r - (dot(normal, grain.x) - plane[w].offset);
      if (delta_n <= 0) {
        touching(g) = static_cast<std::uint8_t>(touching(g) & ~bit);
        continue;
      }
      ContactResult history;
      if (touching(g) & bit) history.xi_t = xi_t(g, w), history.rolling = torque(g, w);
      const Real arm = grain.r - delta_n / 2;
      const ContactResult result = contact_force(
          law, rolling, friction,
          ContactPair{.normal = normal,
                      .delta_n = delta_n,
                      .slip = contact_slip(grain.u, arm * grain.omega, normal),
                      .spin_difference = grain.omega,
                      .r_eff = grain.r,
                      .m_eff = grain.m},
          history, dt);
      force += result.force;
      torque_sum += result.rolling - arm * result.twist;
      xi_t(g, w) = result.xi_t;
      torque(g, w) = result.rolling;
      touching(g) = static_cast<std::uint8_t>(touching(g) | bit);
      largest = delta_n > largest ? delta_n : largest;
    }
    return largest;
  }
};

}  // namespace barchan
