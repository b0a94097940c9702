// Flat walls: the contact law with one side at rest and flat (r_eff = r, m_eff = m).
#pragma once

#include <cstdint>

#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/contact_law.hpp"

namespace barchan {

/// The walls, their material and every grain's history with them. Walls 2s and 2s + 1, which a
/// grain cannot touch together, share the history s.
template <class Stiffness, class Rolling>
struct Walls {
  WallPlanes planes;
  Stiffness law;
  Rolling rolling;
  Friction friction;
  // (grain, wall / 2): [m], [N m]; torque of rolling springs alone
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> xi_t, torque;
  Kokkos::View<std::uint8_t*> touching;  // bit w: grain touches wall w

  KOKKOS_FORCEINLINE_FUNCTION ContactResult remembered(int g, int w) const {
    ContactResult history;
    history.xi_t = xi_t(g, w / 2);
    if constexpr (Rolling::has_history) history.rolling = torque(g, w / 2);
    return history;
  }
  /// Within `margin` of contact with a wall [m]; a grain that is not touches none.
  KOKKOS_FORCEINLINE_FUNCTION std::uint8_t is_near(int g, const GrainKinematics& grain,
                                                   Real margin) const {
    for (int w = 0; w < planes.n; ++w) {
      if (planes[w].overlap(grain) > -margin) return 1;
    }
    touching(g) = 0;
    return 0;
  }
  /// Adds the force and torque of all walls on grain g; advances the history by dt.
  KOKKOS_FORCEINLINE_FUNCTION void add(int g, const GrainKinematics& grain, Real dt,
                                       ContactSum& sum) const {
    const std::uint8_t before = touching(g);
    std::uint8_t now = 0;
    for (int w = 0; w < planes.n; ++w) {
      const std::uint8_t bit = static_cast<std::uint8_t>(1u << w);
      const Vec3& normal = planes[w].normal;
      const Real delta_n = planes[w].overlap(grain);
      if (delta_n <= 0) continue;
      ContactResult history;
      if (before & bit) history = remembered(g, w);
      const Real arm = grain.r - delta_n / 2;
      const ContactResult result =
          contact_force(law, rolling, friction,
                        ContactPair{.normal = normal,
                                    .delta_n = delta_n,
                                    .slip = contact_slip(grain.u, arm * grain.omega, normal),
                                    .spin_difference = grain.omega,
                                    .r_eff = grain.r,
                                    .m_eff = grain.m},
                        history, dt);
      sum.force = sum.force + quad(result.force);
      sum.torque = sum.torque + quad(fused(-arm, result.n_cross_f_t, result.rolling));
      xi_t(g, w / 2) = result.xi_t;
      if constexpr (Rolling::has_history) torque(g, w / 2) = result.rolling;
      now = static_cast<std::uint8_t>(now | bit);
    }
    if (now != before) touching(g) = now;
  }
};

}  // namespace barchan
