// Forces of all listed pairs, a block at a time: find the touching ones, lay them out side by
// side, evaluate the law on all of them at once (vectorised on a CPU), put the results back.
#pragma once

#include "kernels/contact_force.hpp"
#include "kernels/grain.hpp"
#include "kernels/sphere.hpp"

namespace barchan {

/// kBlock pairs per index; 1 on a GPU. Every pair goes through the same full vectors, so its result
/// does not depend on where in a block it stands.
template <class Stiffness, class Rolling, int kBlock>
struct PairForces {
  static constexpr int kVector = kBlock < 8 ? kBlock : 8;

  Stiffness law;
  Rolling rolling;
  Friction friction;
  PeriodicBox box;
  Real dt = 0;  // [s]
  Kokkos::View<const GrainKinematics*> grains;
  PairList list;

  /// Columns of a block: inputs, then results.
  struct Stage {
    Real nx[kBlock], ny[kBlock], nz[kBlock], delta[kBlock];
    Real ux[kBlock], uy[kBlock], uz[kBlock];  // velocity difference, then slip
    Real sx[kBlock], sy[kBlock], sz[kBlock];  // sum of lever arm times spin
    Real wx[kBlock], wy[kBlock], wz[kBlock];  // spin difference
    Real r_eff[kBlock], m_eff[kBlock];
    Real xi_x[kBlock], xi_y[kBlock], xi_z[kBlock];
    Real tx[kBlock], ty[kBlock], tz[kBlock];  // rolling torque
    Real fx[kBlock], fy[kBlock], fz[kBlock];  // force
    Real cx[kBlock], cy[kBlock], cz[kBlock];  // twist
  };

  KOKKOS_FUNCTION void operator()(int block) const {
    const int begin = block * kBlock;
    const int end = begin + kBlock < list.n_pairs ? begin + kBlock : list.n_pairs;
    int touching[kBlock];
    const int n = find_touching(begin, end, touching);
    if (n == 0) return;
    Stage s;
    for (int q = 0; q < n; ++q) load(s, q, touching[q]);
    const int n_full = (n + kVector - 1) / kVector * kVector;
    for (int q = n; q < n_full; ++q) load(s, q, touching[0]);
    evaluate(s, n_full);
    for (int q = 0; q < n; ++q) store(s, q, touching[q]);
  }

  /// Slots in [begin, end) that overlap now; slots that have just parted are cleared.
  KOKKOS_FORCEINLINE_FUNCTION int find_touching(int begin, int end, int* found) const {
    bool overlaps[kBlock];
    for (int p = begin; p < end; ++p) {
      const GrainKinematics& a = grains(list.i(p));
      const GrainKinematics& b = grains(list.j(p));
      const Vec3 s = box.nearest_image(a.x - b.x);
      overlaps[p - begin] = dot(s, s) < (a.r + b.r) * (a.r + b.r);
    }
    int n = 0;
    for (int p = begin; p < end; ++p) {
      const bool touches = overlaps[p - begin];
      found[n] = p;
      n += touches ? 1 : 0;
      if (!touches && list.touching(p)) clear(p);
    }
    return n;
  }

  KOKKOS_FUNCTION void clear(int p) const {
    list.touching(p) = 0;
    list.line(p) = PairLine{};
    list.xi_t(p) = Vec3{};
    if constexpr (Rolling::has_history) list.rolling(p) = Vec3{};
  }

  KOKKOS_FORCEINLINE_FUNCTION void load(Stage& s, int q, int p) const {
    const GrainKinematics& a = grains(list.i(p));
    const GrainKinematics& b = grains(list.j(p));
    const Vec3 separation = box.nearest_image(a.x - b.x);
    s.nx[q] = separation.x, s.ny[q] = separation.y, s.nz[q] = separation.z;
    s.delta[q] = a.r + b.r;
    s.ux[q] = a.u.x - b.u.x, s.uy[q] = a.u.y - b.u.y, s.uz[q] = a.u.z - b.u.z;
    s.sx[q] = a.r * a.omega.x + b.r * b.omega.x;
    s.sy[q] = a.r * a.omega.y + b.r * b.omega.y;
    s.sz[q] = a.r * a.omega.z + b.r * b.omega.z;
    s.wx[q] = a.omega.x, s.wy[q] = a.omega.y, s.wz[q] = a.omega.z;
    s.fx[q] = b.omega.x, s.fy[q] = b.omega.y, s.fz[q] = b.omega.z;
    s.r_eff[q] = effective(a.r, b.r);
    s.m_eff[q] = effective(a.m, b.m);
    const Vec3& xi = list.xi_t(p);
    s.xi_x[q] = xi.x, s.xi_y[q] = xi.y, s.xi_z[q] = xi.z;
    if constexpr (Rolling::has_history) {
      const Vec3& t = list.rolling(p);
      s.tx[q] = t.x, s.ty[q] = t.y, s.tz[q] = t.z;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void evaluate(Stage& s, int n) const {
#pragma GCC ivdep
    for (int q = 0; q < n; ++q) {
      const Vec3 separation{s.nx[q], s.ny[q], s.nz[q]};
      const Real distance = norm(separation);
      const Vec3 normal = (1 / distance) * separation;
      const Real delta_n = s.delta[q] - distance;
      const Vec3 omega_i{s.wx[q], s.wy[q], s.wz[q]}, omega_j{s.fx[q], s.fy[q], s.fz[q]};
      const Vec3 arm_spin =
          Vec3{s.sx[q], s.sy[q], s.sz[q]} - (delta_n / 2) * (omega_i + omega_j);
      const Vec3 slip = contact_slip(Vec3{s.ux[q], s.uy[q], s.uz[q]}, arm_spin, normal);
      ContactResult history;
      history.xi_t = Vec3{s.xi_x[q], s.xi_y[q], s.xi_z[q]};
      if constexpr (Rolling::has_history) history.rolling = Vec3{s.tx[q], s.ty[q], s.tz[q]};
      const ContactResult result = contact_force(law, rolling, friction,
                                                 ContactPair{.normal = normal,
                                                             .delta_n = delta_n,
                                                             .slip = slip,
                                                             .spin_difference = omega_i - omega_j,
                                                             .r_eff = s.r_eff[q],
                                                             .m_eff = s.m_eff[q]},
                                                 history, dt);
      s.delta[q] = delta_n;
      s.fx[q] = result.force.x, s.fy[q] = result.force.y, s.fz[q] = result.force.z;
      s.cx[q] = result.twist.x, s.cy[q] = result.twist.y, s.cz[q] = result.twist.z;
      s.xi_x[q] = result.xi_t.x, s.xi_y[q] = result.xi_t.y, s.xi_z[q] = result.xi_t.z;
      s.tx[q] = result.rolling.x, s.ty[q] = result.rolling.y, s.tz[q] = result.rolling.z;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(const Stage& s, int q, int p) const {
    PairLine& line = list.line(p);
    line.force = Vec3{s.fx[q], s.fy[q], s.fz[q]};
    line.delta_n = s.delta[q];
    line.twist = Vec3{s.cx[q], s.cy[q], s.cz[q]};
    list.xi_t(p) = Vec3{s.xi_x[q], s.xi_y[q], s.xi_z[q]};
    list.touching(p) = 1;
    // Without a spring the torque of the constant-torque law still has to reach the gather.
    if (list.rolling.extent(0) > 0) list.rolling(p) = Vec3{s.tx[q], s.ty[q], s.tz[q]};
  }
};

}  // namespace barchan
