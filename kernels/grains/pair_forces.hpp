// Forces of listed pairs, a block at a time: lays the pairs out side by side, evaluates the law on
// the whole block (vectorised on a CPU), hands the results on.
#pragma once

#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/contact_tile.hpp"
#include "kernels/grains/half_step_slip.hpp"
#include "kernels/grains/list_validity.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/math/prefetch.hpp"

namespace barchan {

/// Computes the pairs. As a kernel, it takes the inter-chunk pairs, kTile of them per index.
template <class Law>
struct PairForces {
  using Contacts = ContactTile<Law>;
  static constexpr bool kRolls = Law::kRolls;
  static constexpr int kAhead = 16;  // pairs that are fetched before their turn

  Law law;
  PeriodicBox box;
  ListValidity validity;
  Kokkos::View<const GrainKinematics*> grains;
  PairList list;
  bool keep_force = false;  // set in the last grain step if the force of each pair is asked for

  /// A block of pairs (a, b), an entry each.
  struct Tile {
    AosTile separation, slip, omega_a, omega_b;
    alignas(64) Real r_a[kTile], r_b[kTile], m_a[kTile], m_b[kTile];
    alignas(64) Real arm_a[kTile], arm_b[kTile];  // from the centres to the contact [m]
    Contacts contacts;
  };

  KOKKOS_FUNCTION void operator()(int block) const {
    if (!validity.holds()) return;
    if constexpr (kTile == 1) {  // constant indices: the tile stays in registers
      if (!is_near(block, 0)) return;
      Tile s;
      load(s, 0, block);
      find_contact(s, 0);
      s.contacts.evaluate(law, 1);
      store_history(s.contacts, 0, block);
      store_pair_force(s.contacts, 0, block);
      return;
    }
    const int begin = block * kTile;
    const int end = begin + size_of_block(begin, list.n_inter);
    int slots[kTile];
    int n = 0;
    for (int p = begin; p < end; ++p) {
      fetch_grains(p + kAhead < list.n_inter ? p + kAhead : p);
      slots[n] = p;
      n += is_near(p, 0) ? 1 : 0;
    }
    if (n == 0) return;
    Tile s;
    evaluate(s, slots, n, n);
    for (int q = 0; q < n; ++q) store_pair_force(s.contacts, q, slots[q]);
  }

  /// Adds the forces of the active pairs of a chunk to sums[0..], one for each of its entries.
  KOKKOS_FUNCTION void add_intra_chunk(int chunk, ContactSum* sums) const {
    const int first_entry = list.chunks.begin(chunk);
    const int* active = &list.active(list.intra_first(first_entry) - list.n_inter);
    const int n_active = list.n_active(chunk);
    Tile s;
    for (int begin = 0; begin < n_active; begin += kTile) {
      const int n = size_of_block(begin, n_active);
      const int* slots = active + begin;
      evaluate(s, slots, n, n_active - begin);
      for (int q = 0; q < n; ++q) {
        const int p = slots[q];
        const Vec4 force = s.contacts.force[q], n_cross_f_t = s.contacts.n_cross_f_t[q];
        ContactSum& a = sums[list.i(p) - first_entry];
        a.force = a.force + force;
        a.torque = fma(-s.arm_a[q], n_cross_f_t, a.torque);
        if constexpr (kRolls) a.torque = a.torque + s.contacts.rolling[q];
        ContactSum& b = sums[list.j(p) - first_entry];
        b.force = b.force - force;
        b.torque = fma(-s.arm_b[q], n_cross_f_t, b.torque);
        if constexpr (kRolls) b.torque = b.torque - s.contacts.rolling[q];
      }
    }
  }

  /// Marks as active the intra-chunk pairs of a chunk that come into contact if both grains go as
  /// far as their slacks.
  KOKKOS_FUNCTION void find_active(int chunk) const {
    const int begin = list.intra_first(list.chunks.begin(chunk));
    const int end = list.intra_first(list.chunks.end(chunk));
    int* active = &list.active(begin - list.n_inter);
    int n = 0;
    for (int p = begin; p < end; ++p) {
      active[n] = p;
      n += is_near(p, list.slack(list.i(p)) + list.slack(list.j(p))) ? 1 : 0;
    }
    list.n_active(chunk) = n;
  }

  /// Tells if a pair is within `margin` of contact; clears the history of one that is not.
  KOKKOS_FORCEINLINE_FUNCTION bool is_near(int p, Real margin) const {
    const GrainKinematics& a = grains(list.i(p));
    const GrainKinematics& b = grains(list.j(p));
    const Vec3 s = box.nearest_image(a.x - b.x);
    const Real most =
        a.r + b.r + (margin + reach(stiffness_of(p), effective_pair(a.r, b.r, a.m, b.m).r));
    const bool near = dot(s, s) < most * most;
    // A single condition: a branch on `near` alone would go either way, often against the guess.
    if (static_cast<int>(!near) & list.touching(p)) clear(p);
    return near;
  }

  KOKKOS_FORCEINLINE_FUNCTION const auto& stiffness_of(int p) const {
    if constexpr (Law::kMany) {
      return law.table.of(list.law(p));
    } else {
      return law.table.of(0);
    }
  }

  KOKKOS_FUNCTION void clear(int p) const {
    list.touching(p) = 0;
    if (p < list.n_inter) list.pair_force(p) = PairForce{};
    list.xi_t(p) = Vec3{};
    if constexpr (kRolls) list.rolling(p) = Vec3{};
  }

  KOKKOS_FORCEINLINE_FUNCTION void fetch_grains(int p) const {
    prefetch(grains(list.i(p)));
    prefetch(grains(list.j(p)));
  }

  /// Loads n pairs, evaluates them and stores their history; `n_to_come`: entries of `slots`, those
  /// of later blocks among them.
  KOKKOS_FORCEINLINE_FUNCTION void evaluate(Tile& s, const int* slots, int n, int n_to_come) const {
    for (int q = 0; q < n; ++q) {
      const int ahead = slots[q + kAhead < n_to_come ? q + kAhead : q];
      prefetch(grains(list.j(ahead)));
      prefetch(list.xi_t(ahead));
      load(s, q, slots[q]);
    }
    const int n_full = Contacts::whole_vectors(n);
    for (int q = n; q < n_full; ++q) load(s, q, slots[0]);
#pragma GCC ivdep
    for (int q = 0; q < n_full; ++q) find_contact(s, q);
    s.contacts.evaluate(law, n_full);
    for (int q = 0; q < n; ++q) store_history(s.contacts, q, slots[q]);
  }

  KOKKOS_FORCEINLINE_FUNCTION void load(Tile& s, int q, int p) const {
    const GrainKinematics& a = grains(list.i(p));
    const GrainKinematics& b = grains(list.j(p));
    s.separation.store(q, a.x_r() - b.x_r());
    s.slip.store(q, a.u_m() - b.u_m());
    s.omega_a.store(q, a.omega_skin()), s.omega_b.store(q, b.omega_skin());
    s.r_a[q] = a.r, s.r_b[q] = b.r, s.m_a[q] = a.m, s.m_b[q] = b.m;
    s.contacts.xi_t.store(q, vec4(list.xi_t(p)));
    if constexpr (Law::kMany) s.contacts.law_of[q] = list.law(p);
    if constexpr (Law::Rolling::has_history) s.contacts.rolling.store(q, vec4(list.rolling(p)));
  }

  KOKKOS_FORCEINLINE_FUNCTION void find_contact(Tile& s, int q) const {
    const Vec3 separation = box.nearest_image(s.separation.vec(q));
    const Real distance = norm(separation);
    const Vec3 normal = (1 / distance) * separation;
    const Real r_a = s.r_a[q], r_b = s.r_b[q];
    const EffectivePair effective = effective_pair(r_a, r_b, s.m_a[q], s.m_b[q]);
    const Real overlap = r_a + r_b - distance;
    const auto& stiffness = law.table.of(s.contacts.law_at(q));
    const Real delta_n =
        in_contact(stiffness, effective.r, overlap) ? overlap : -reach(stiffness, effective.r);
    const Vec3 omega_a = s.omega_a.vec(q), omega_b = s.omega_b.vec(q);
    const Real arm_a = r_a - delta_n / 2, arm_b = r_b - delta_n / 2;
    s.arm_a[q] = arm_a, s.arm_b[q] = arm_b;
    const Vec3 arm_omega = fma(arm_a, omega_a, arm_b * omega_b), velocity = s.slip.vec(q);
    Vec3 slip;
    if constexpr (Law::kMany) {
      slip = slip_half_a_step_ago(separation, normal, velocity, arm_omega, law.dt);
    } else {
      slip = contact_slip(velocity, arm_omega, normal);
    }
    s.contacts.store(q, {.normal = normal,
                         .delta_n = delta_n,
                         .slip = slip,
                         .omega_difference = omega_a - omega_b,
                         .r_eff = effective.r,
                         .m_eff = effective.m});
  }

  KOKKOS_FORCEINLINE_FUNCTION void store_history(const Contacts& c, int q, int p) const {
    list.xi_t(p) = c.xi_t.vec(q);
    list.touching(p) = c.touches(law, q) ? 1 : 0;
    if constexpr (kRolls) list.rolling(p) = c.rolling.vec(q);
    if (keep_force) list.force(p) = c.force.vec(q);
  }

  KOKKOS_FORCEINLINE_FUNCTION void store_pair_force(const Contacts& c, int q, int p) const {
    list.pair_force(p) = {c.force[q], c.n_cross_f_t[q]};
  }
};

}  // namespace barchan
