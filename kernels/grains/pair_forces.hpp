// Forces of listed pairs, a block at a time: lay the pairs out side by side, evaluate the law on
// the whole block (vectorised on a CPU), hand the results on.
#pragma once

#include <type_traits>

#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/contact_law.hpp"

namespace barchan {

/// Pairs laid side by side in one block: enough to fill vectors, small enough for the L1 cache.
inline constexpr int kBlock = kLargestChunk > 1 ? 32 : 1;

/// A Quad of each pair of a block, as numbers that a loop over the pairs can read.
struct BlockOfQuads {
  alignas(64) Real row[kBlock][Quad::kSize];

  KOKKOS_FORCEINLINE_FUNCTION Quad operator[](int q) const { return Quad(row[q]); }
  KOKKOS_FORCEINLINE_FUNCTION void put(int q, const Quad& a) { a.store(row[q]); }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec(int q) const { return {row[q][0], row[q][1], row[q][2]}; }
};

/// Vectors of the pairs of a block, component by component: the law writes these in full vectors,
/// in a pass of its own they become one Quad a pair.
struct BlockOfVectors {
  alignas(64) Real x[kBlock], y[kBlock], z[kBlock], w[kBlock];

  KOKKOS_FORCEINLINE_FUNCTION void put(int q, const Vec3& a, Real a_w) {
    x[q] = a.x, y[q] = a.y, z[q] = a.z, w[q] = a_w;
  }
  KOKKOS_FORCEINLINE_FUNCTION void to_quads(int n, BlockOfQuads& to) const {
#pragma GCC ivdep
    for (int q = 0; q < n; ++q)
      to.row[q][0] = x[q], to.row[q][1] = y[q], to.row[q][2] = z[q], to.row[q][3] = w[q];
  }
};

/// As a kernel: the crossing pairs, kBlock of them per index. Every pair goes through the same full
/// vectors, so its result does not depend on its position in the block.
template <class Stiffness, class Rolling>
struct PairForces {
  static constexpr bool kRolls = !std::is_same_v<Rolling, NoRolling>;
  static constexpr int kVector = kBlock < 8 ? kBlock : 8;  // pairs in the widest vectors
  static constexpr int kAhead = 16;  // pairs that are fetched before their turn

  Stiffness law;
  Rolling rolling;
  Friction friction;
  PeriodicBox box;
  Real dt = 0;  // [s]
  ListValidity validity;
  Kokkos::View<const GrainKinematics*> grains;
  PairList list;
  bool keep_force = false;  // the last sub-step, and someone asks for the force of each pair

  /// A block of pairs (a, b), a row each: inputs, history, results.
  struct Stage {
    BlockOfQuads separation, slip, spin_a, spin_b;
    Real r_a[kBlock], r_b[kBlock], m_a[kBlock], m_b[kBlock];
    BlockOfQuads xi, rolling;
    BlockOfQuads force, n_cross_f_t;  // the fourth of force: overlap
    BlockOfVectors new_xi, new_rolling, new_force, new_n_cross_f_t;
  };

  KOKKOS_FUNCTION void operator()(int block) const {
    if (!validity.holds()) return;
    if constexpr (kBlock == 1) {  // constant indices: the stage stays in registers
      if (!is_near(block, 0)) return;
      Stage s;
      load(s, 0, block);
      apply_law(s, 0);
      collect(s, 1);
      store_history(s, 0, block);
      store_pair_force(s, 0, block);
      return;
    }
    const int begin = block * kBlock;
    const int end = begin + kBlock < list.n_crossing ? begin + kBlock : list.n_crossing;
    int slots[kBlock];
    int n = 0;
    for (int p = begin; p < end; ++p) {
      fetch_grains(p + kAhead < list.n_crossing ? p + kAhead : p);
      slots[n] = p;
      n += is_near(p, 0) ? 1 : 0;
    }
    if (n == 0) return;
    Stage s;
    evaluate(s, slots, n, n);
    for (int q = 0; q < n; ++q) store_pair_force(s, q, slots[q]);
  }

  /// Adds the forces of the active pairs of a chunk to sums[0..], one for each of its rows.
  KOKKOS_FUNCTION void add_inner(int chunk, ContactSum* sums) const {
    const int first_row = list.chunks.begin(chunk);
    const int* active = &list.active(list.inner_first(first_row) - list.n_crossing);
    const int n_active = list.n_active(chunk);
    Stage s;
    for (int begin = 0; begin < n_active; begin += kBlock) {
      const int n = begin + kBlock < n_active ? kBlock : n_active - begin;
      const int* slots = active + begin;
      evaluate(s, slots, n, n_active - begin);
      for (int q = 0; q < n; ++q) {
        const int p = slots[q];
        const Real half_overlap = s.force[q].w() / 2;
        ContactSum& a = sums[list.i(p) - first_row];
        a.force = a.force + s.force[q];
        a.torque = fused(half_overlap - s.r_a[q], s.n_cross_f_t[q], a.torque);
        if constexpr (kRolls) a.torque = a.torque + s.rolling[q];
        ContactSum& b = sums[list.j(p) - first_row];
        b.force = b.force - s.force[q];
        b.torque = fused(half_overlap - s.r_b[q], s.n_cross_f_t[q], b.torque);
        if constexpr (kRolls) b.torque = b.torque - s.rolling[q];
      }
    }
  }

  /// Lists the inner pairs of a chunk as active that come into contact if both go as far as their
  /// slacks.
  KOKKOS_FUNCTION void find_active(int chunk) const {
    const int begin = list.inner_first(list.chunks.begin(chunk));
    const int end = list.inner_first(list.chunks.end(chunk));
    int* active = &list.active(begin - list.n_crossing);
    int n = 0;
    for (int p = begin; p < end; ++p) {
      active[n] = p;
      n += is_near(p, list.slack(list.i(p)) + list.slack(list.j(p))) ? 1 : 0;
    }
    list.n_active(chunk) = n;
  }

  /// Within `margin` of contact; a pair that is not has its history cleared.
  KOKKOS_FORCEINLINE_FUNCTION bool is_near(int p, Real margin) const {
    const GrainKinematics& a = grains(list.i(p));
    const GrainKinematics& b = grains(list.j(p));
    const Vec3 s = box.nearest_image(a.x - b.x);
    const Real reach = a.r + b.r + margin;
    const bool near = dot(s, s) < reach * reach;
    if (!near && list.touching(p)) clear(p);
    return near;
  }

  KOKKOS_FUNCTION void clear(int p) const {
    list.touching(p) = 0;
    if (p < list.n_crossing) list.pair_force(p) = PairForce{};
    list.xi_t(p) = Vec3{};
    if constexpr (kRolls) list.rolling(p) = Vec3{};
  }

  KOKKOS_FORCEINLINE_FUNCTION void fetch_grains(int p) const {
    prefetch(grains(list.i(p)));
    prefetch(grains(list.j(p)));
  }

  /// Loads n pairs, evaluates them and stores their history; `n_to_come`: entries of `slots`, those
  /// of later blocks among them.
  KOKKOS_FORCEINLINE_FUNCTION void evaluate(Stage& s, const int* slots, int n,
                                            int n_to_come) const {
    for (int q = 0; q < n; ++q) {
      const int ahead = slots[q + kAhead < n_to_come ? q + kAhead : q];
      prefetch(grains(list.j(ahead)));
      prefetch(list.xi_t(ahead));
      load(s, q, slots[q]);
    }
    const int n_full = (n + kVector - 1) / kVector * kVector;
    for (int q = n; q < n_full; ++q) load(s, q, slots[0]);
#pragma GCC ivdep
    for (int q = 0; q < n_full; ++q) apply_law(s, q);
    collect(s, n_full);
    for (int q = 0; q < n; ++q) store_history(s, q, slots[q]);
  }

  KOKKOS_FORCEINLINE_FUNCTION void load(Stage& s, int q, int p) const {
    const GrainKinematics& a = grains(list.i(p));
    const GrainKinematics& b = grains(list.j(p));
    s.separation.put(q, a.x_r() - b.x_r());
    s.slip.put(q, a.u_m() - b.u_m());
    s.spin_a.put(q, a.spin()), s.spin_b.put(q, b.spin());
    s.r_a[q] = a.r, s.r_b[q] = b.r, s.m_a[q] = a.m, s.m_b[q] = b.m;
    s.xi.put(q, quad(list.xi_t(p)));
    if constexpr (Rolling::has_history) s.rolling.put(q, quad(list.rolling(p)));
  }

  KOKKOS_FORCEINLINE_FUNCTION void apply_law(Stage& s, int q) const {
    const Vec3 separation = box.nearest_image(s.separation.vec(q));
    const Real distance = norm(separation);
    const Vec3 normal = (1 / distance) * separation;
    const Real r_a = s.r_a[q], r_b = s.r_b[q];
    const EffectivePair effective = effective_pair(r_a, r_b, s.m_a[q], s.m_b[q]);
    const Real overlap = r_a + r_b - distance;
    const bool touches = overlap > 0;
    const Real delta_n = touches ? overlap : 0;
    const Vec3 spin_a = s.spin_a.vec(q), spin_b = s.spin_b.vec(q);
    const Vec3 arm_spin = fused(r_a - delta_n / 2, spin_a, (r_b - delta_n / 2) * spin_b);
    ContactResult history;
    history.xi_t = s.xi.vec(q);
    if constexpr (Rolling::has_history) history.rolling = s.rolling.vec(q);
    const ContactResult result =
        contact_force(law, rolling, friction,
                      ContactPair{.normal = normal,
                                  .delta_n = delta_n,
                                  .slip = contact_slip(s.slip.vec(q), arm_spin, normal),
                                  .spin_difference = spin_a - spin_b,
                                  .r_eff = effective.r,
                                  .m_eff = effective.m},
                      history, dt);
    const Real on = touches ? 1 : 0;
    s.new_force.put(q, on * result.force, delta_n);
    s.new_n_cross_f_t.put(q, on * result.n_cross_f_t, 0);
    s.new_xi.put(q, on * result.xi_t, 0);
    if constexpr (kRolls) s.new_rolling.put(q, on * result.rolling, 0);
  }
  KOKKOS_FORCEINLINE_FUNCTION static void collect(Stage& s, int n) {
    s.new_force.to_quads(n, s.force);
    s.new_n_cross_f_t.to_quads(n, s.n_cross_f_t);
    s.new_xi.to_quads(n, s.xi);
    if constexpr (kRolls) s.new_rolling.to_quads(n, s.rolling);
  }

  KOKKOS_FORCEINLINE_FUNCTION void store_history(const Stage& s, int q, int p) const {
    list.xi_t(p) = s.xi.vec(q);
    list.touching(p) = s.force[q].w() > 0 ? 1 : 0;
    if constexpr (kRolls) list.rolling(p) = s.rolling.vec(q);
    if (keep_force) list.force(p) = s.force.vec(q);
  }

  KOKKOS_FORCEINLINE_FUNCTION void store_pair_force(const Stage& s, int q, int p) const {
    list.pair_force(p) = {s.force[q], s.n_cross_f_t[q]};
  }
};

}  // namespace barchan
