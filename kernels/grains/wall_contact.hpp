// Contacts of grains with walls: the contact law with one side at rest (m_eff = m), flat (r_eff =
// r) or a glued sphere.
#pragma once

#include <cstdint>

#include "kernels/grains/chunks.hpp"
#include "kernels/grains/contact_tile.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {

/// Walls, their material, and the contact history of every grain with them.
template <class Law>
struct Walls {
  WallShapes shapes;
  Law law;
  Kokkos::View<const GrainKinematics*> grains;
  // (grain, history of the wall): [m], [N m]; torque of rolling springs alone
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> xi_t, torque;
  Kokkos::View<std::uint8_t*> touching;    // bit w: grain touches wall w
  Kokkos::View<const std::uint8_t*> kind;  // kinds of the grains; empty: one kind

  /// Block of contacts: grain, wall, and lever arm [m] of each.
  struct Tile {
    int grain[kTile], wall[kTile];
    Real arm[kTile];
    ContactTile<Law> contacts;
  };

  /// Tells if a grain is within `margin` of contact with a wall [m]; a grain that is not touches
  /// none.
  KOKKOS_FORCEINLINE_FUNCTION std::uint8_t is_near(int g, Real margin) const {
    for (int w = 0; w < shapes.n; ++w) {
      if (shapes.at(w, grains(g).x).overlap(grains(g)) > -(margin + reach_of(g, w))) return 1;
    }
    touching(g) = 0;
    return 0;
  }

  /// Adds the forces and torques of all walls on the near grains of entries [begin, end) to
  /// sums[0..], and advances their history by a grain step.
  template <class Near>
  KOKKOS_FORCEINLINE_FUNCTION void add(int begin, int end, const Near& near,
                                       ContactSum* sums) const {
    Tile s;
    int n = 0;
    for (int g = begin; g < end; ++g) {
      if (!near(g)) continue;
      const std::uint8_t before = touching(g);
      std::uint8_t now = 0;
      for (int w = 0; w < shapes.n; ++w) {
        const Real overlap = shapes.at(w, grains(g).x).overlap(grains(g));
        if (!in_contact(stiffness_of(g), shapes.effective_radius(w, grains(g).r), overlap))
          continue;
        const std::uint8_t bit = static_cast<std::uint8_t>(1u << w);
        now = static_cast<std::uint8_t>(now | bit);
        load(s, n, g, w, (before & bit) != 0);
        if (++n == kTile) {
          evaluate(s, kTile, begin, sums);
          n = 0;
        }
      }
      if (now != before) touching(g) = now;
    }
    if (kTile > 1 && n > 0) evaluate(s, n, begin, sums);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION const auto& stiffness_of(int g) const {
    if constexpr (Law::kMany) {
      return law.table.of(law_entry(kind(g), 0));
    } else {
      return law.table.of(0);
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION Real reach_of(int g, int w) const {
    return reach(stiffness_of(g), shapes.effective_radius(w, grains(g).r));
  }
  KOKKOS_FORCEINLINE_FUNCTION void load(Tile& s, int q, int g, int w, bool touched) const {
    const GrainKinematics& grain = grains(g);
    const Plane plane = shapes.at(w, grain.x);
    const Vec3& normal = plane.normal;
    const Real delta_n = plane.overlap(grain), arm = grain.r - delta_n / 2;
    const int h = shapes.history[w];
    s.grain[q] = g, s.wall[q] = w, s.arm[q] = arm;
    s.contacts.store(q, {.normal = normal,
                         .delta_n = delta_n,
                         .slip = contact_slip(grain.u, arm * grain.omega, normal),
                         .omega_difference = grain.omega,
                         .r_eff = shapes.effective_radius(w, grain.r),
                         .m_eff = grain.m});
    if constexpr (Law::kMany) s.contacts.law_of[q] = law_entry(kind(g), 0);
    s.contacts.xi_t.store(q, vec4(touched ? xi_t(g, h) : Vec3{}));
    if constexpr (Law::Rolling::has_history) {
      s.contacts.rolling.store(q, vec4(touched ? torque(g, h) : Vec3{}));
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION void evaluate(Tile& s, int n, int begin, ContactSum* sums) const {
    const int n_full = ContactTile<Law>::whole_vectors(n);
    for (int q = n; q < n_full; ++q) load(s, q, s.grain[0], s.wall[0], true);
    s.contacts.evaluate(law, n_full);
    for (int q = 0; q < n; ++q) {
      const int g = s.grain[q], h = shapes.history[s.wall[q]];
      ContactSum& sum = sums[place_in_chunk(g, begin)];
      sum.force = sum.force + vec4(s.contacts.force.vec(q));
      sum.torque = fma(-s.arm[q], s.contacts.n_cross_f_t[q], sum.torque);
      if constexpr (Law::kRolls) sum.torque = sum.torque + s.contacts.rolling[q];
      xi_t(g, h) = s.contacts.xi_t.vec(q);
      if constexpr (Law::Rolling::has_history) torque(g, h) = s.contacts.rolling.vec(q);
    }
  }
};

}  // namespace barchan
