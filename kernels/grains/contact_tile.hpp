// The contact law on a block of contacts at once, between grains or of grains with walls.
#pragma once

#include "kernels/grains/law_table.hpp"
#include "kernels/grains/tile.hpp"

namespace barchan {

/// Block of contacts: geometry, relative motion and history in, forces and history out. Each
/// contact goes through the same full vectors, so its result does not depend on its place in the
/// block. The passes are short, so that a CPU has several vectors of contacts under way in each:
/// roots and divisions take long, one after another.
template <class Law>
struct ContactTile {
  static constexpr bool kRolls = Law::kRolls;
  static constexpr int kVector = kTile < 8 ? kTile : 8;  // contacts in the widest vectors

  SoaTile normal;            // normal and overlap [m], the latter minus the reach if apart
  SoaTile slip;              // [m/s]
  SoaTile omega_difference;  // [rad/s]
  AosTile xi_t;              // [m], before and after
  AosTile rolling;           // [N m], before and after
  AosTile force;             // result [N], and the overlap [m]
  AosTile n_cross_f_t;       // result [N]
  alignas(64) Real r_eff[kTile], m_eff[kTile];  // [m], [kg]
  alignas(64) Real elastic[kTile], k_t[kTile], gamma_n[kTile],
      gamma_t[kTile];                           // [N], [N/m], [kg/s]
  std::uint8_t law_of[Law::kMany ? kTile : 1];  // entry in the table of laws; unused for one kind
  SoaTile new_force, new_n_cross_f_t, new_xi_t, new_rolling;

  /// Number of contacts, rounded up to whole vectors; the block has room for them.
  KOKKOS_FORCEINLINE_FUNCTION static int whole_vectors(int n) {
    return (n + kVector - 1) / kVector * kVector;
  }

  KOKKOS_FORCEINLINE_FUNCTION std::uint8_t law_at(int q) const {
    if constexpr (Law::kMany) {
      return law_of[q];
    } else {
      return 0;
    }
  }
  /// Tells if contact q touches; call it after evaluate().
  KOKKOS_FORCEINLINE_FUNCTION bool touches(const Law& law, int q) const {
    return in_contact(law.table.of(law_at(q)), r_eff[q], force[q].w());
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(int q, const ContactPair& pair) {
    normal.store(q, pair.normal, pair.delta_n);
    slip.store(q, pair.slip, 0);
    if constexpr (kRolls) omega_difference.store(q, pair.omega_difference, 0);
    r_eff[q] = pair.r_eff, m_eff[q] = pair.m_eff;
  }

  /// Evaluates the first n contacts; n is a multiple of kVector.
  KOKKOS_FORCEINLINE_FUNCTION void evaluate(const Law& law, int n) {
#pragma GCC ivdep
    for (int q = 0; q < n; ++q) find_stiffness(law, q);
#pragma GCC ivdep
    for (int q = 0; q < n; ++q) find_force(law, q);
    new_force.to_aos(n, force);
    new_n_cross_f_t.to_aos(n, n_cross_f_t);
    new_xi_t.to_aos(n, xi_t);
    if constexpr (kRolls) new_rolling.to_aos(n, rolling);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void find_stiffness(const Law& law, int q) {
    const ContactStiffness k = law.table.of(law_at(q))(r_eff[q], m_eff[q], normal.w[q]);
    elastic[q] = k.elastic, k_t[q] = k.k_t, gamma_n[q] = k.gamma_n, gamma_t[q] = k.gamma_t;
  }
  KOKKOS_FORCEINLINE_FUNCTION void find_force(const Law& law, int q) {
    const Real delta_n = normal.w[q];
    ContactPair pair{.normal = normal.vec(q),
                     .delta_n = delta_n,
                     .slip = slip.vec(q),
                     .omega_difference = {},
                     .r_eff = r_eff[q],
                     .m_eff = m_eff[q]};
    if constexpr (kRolls) pair.omega_difference = omega_difference.vec(q);
    ContactResult history;
    history.xi_t = xi_t.vec(q);
    if constexpr (Law::Rolling::has_history) history.rolling = rolling.vec(q);
    const ContactResult result = contact_force(
        ContactStiffness{
            .elastic = elastic[q], .k_t = k_t[q], .gamma_n = gamma_n[q], .gamma_t = gamma_t[q]},
        law.rolling, law.table.friction[law.table.at(law_at(q))], pair, history, law.dt);
    const Real on = in_contact(law.table.of(law_at(q)), r_eff[q], delta_n) ? 1 : 0;
    const Real touch = acts_apart<typename Law::Stiffness>() && !(delta_n > 0) ? 0 : on;
    new_force.store(q, on * result.force, delta_n);
    new_n_cross_f_t.store(q, touch * result.n_cross_f_t, 0);
    new_xi_t.store(q, touch * result.xi_t, 0);
    if constexpr (kRolls) new_rolling.store(q, touch * result.rolling, 0);
  }
};

}  // namespace barchan
