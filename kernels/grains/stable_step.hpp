// Longest grain step for which contacts are stable. In a packing the tangential dashpots of all
// contacts of a grain brake its spin together: they, not the springs, limit an explicit step.
#pragma once

#include "kernels/grains/body_contact.hpp"
#include "kernels/grains/clump.hpp"
#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/law_table.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/grains/step_limit.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {

/// Adds up the tangential springs and dashpots of the contacts of each grain; reduces the shortest
/// step of any contact alone [s]. The sums give the step within some 10 % of that of all grains
/// together (docs/theory-grains.md).
template <class Laws>
struct TangentialOfPairs {
  Laws laws;  // a LawTable
  PeriodicBox box;
  PairList list;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<Real* [2]> sums;            // (n): stiffness [N/m], damping [kg/s]
  Kokkos::View<const std::uint8_t*> kind;  // kinds of the grains; empty: one kind
  Kokkos::View<const std::int64_t*> id;
  ClumpShapes shapes = {};

  KOKKOS_FUNCTION void operator()(int p, Real& shortest) const {
    const int i = list.i(p), j = list.j(p);
    const GrainKinematics &a = grains(i), &b = grains(j);
    const Real overlap = a.r + b.r - norm(box.nearest_image(a.x - b.x));
    const EffectivePair effective = effective_pair(a.r, b.r, a.m, b.m);
    const auto& law = laws.of(list.has_laws() ? list.law(p) : std::uint8_t{0});
    if (!in_contact(law, effective.r, overlap)) return;
    const ContactStiffness k = law(effective.r, effective.m, overlap);
    add(i, k);
    add(j, k);
    const Real slip = Kokkos::min(shapes.in_contacts_of(kind, id, i).slip,
                                  shapes.in_contacts_of(kind, id, j).slip);
    const Real step = stable_step(k.k_t, k.gamma_t, slip * effective.m);
    shortest = step < shortest ? step : shortest;
  }
  /// Adds a contact to a grain of this rank; ghosts are skipped.
  KOKKOS_FUNCTION void add(int g, const ContactStiffness& k) const {
    if (g >= list.chunks.n) return;
    Kokkos::atomic_add(&sums(g, 0), k.k_t);
    Kokkos::atomic_add(&sums(g, 1), k.gamma_t);
  }
};

/// Tangential springs and dashpots of a grain.
struct TangentialSums {
  Real stiffness = 0, damping = 0;  // [N/m], [kg/s]
};

/// Adds the contacts with walls and bodies; reduces the shortest step of all grains [s].
template <class Laws>
struct StableStepOfGrains {
  Laws laws;  // a LawTable for the walls
  WallShapes walls;
  Bodies bodies;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const Real* [2]> sums;
  Kokkos::View<const std::uint8_t*> kind;  // kinds of the grains; empty: one kind
  Kokkos::View<const std::int64_t*> id;
  ClumpShapes shapes = {};

  KOKKOS_FUNCTION void operator()(int g, Real& shortest) const {
    const TangentialSums all = contacts_of(g, shortest);
    take_spin(all, g, shortest);
  }
  /// Takes the step of the spin of a grain with all of its contacts.
  KOKKOS_FUNCTION void take_spin(const TangentialSums& all, int g, Real& shortest) const {
    if (all.stiffness <= 0) return;
    const Real step = stable_step(all.stiffness, all.damping, spin_of(g) * grains(g).m);
    shortest = step < shortest ? step : shortest;
  }
  /// Inertia over its mass of the grain or clump of an entry, against spin by its contacts.
  KOKKOS_FORCEINLINE_FUNCTION Real spin_of(int g) const {
    return shapes.in_contacts_of(kind, id, g).spin;
  }
  /// Sums up the contacts of a grain; takes the step of each with a wall or a body alone.
  KOKKOS_FUNCTION TangentialSums contacts_of(int g, Real& shortest) const {
    const GrainKinematics& grain = grains(g);
    const InertiaInContacts inertia = shapes.in_contacts_of(kind, id, g);
    const auto& law = laws.of(kind.extent(0) > 0 ? law_entry(kind(g), 0) : std::uint8_t{0});
    Real stiffness = sums(g, 0), damping = sums(g, 1);
    const auto take = [&](Real step) { shortest = step < shortest ? step : shortest; };
    const auto add = [&](Real overlap, Real r_eff) {
      if (!in_contact(law, r_eff, overlap)) return;
      const ContactStiffness k = law(r_eff, grain.m, overlap);
      stiffness += k.k_t, damping += k.gamma_t;
      take(stable_step(k.k_t, k.gamma_t, inertia.slip * grain.m));
    };
    for (int w = 0; w < walls.n; ++w)
      add(walls.at(w, grain.x).overlap(grain), walls.effective_radius(w, grain.r));
    for (int b = 0; b < bodies.n; ++b)
      add(grain.r - bodies.body[b].distance(grain.x), effective_radius(bodies.body[b], grain.r));
    return {stiffness, damping};
  }
};

/// The same for clumps, whose spheres turn together: a contact counts by how much it turns them, as
/// many of the first sphere. Clumps that stand on planes with all contacts at their worst points
/// and directions need up to 1.24 times shorter steps (sand; cubes 1.10): they move and turn at
/// once.
template <class Laws>
struct StableStepOfClumps {
  StableStepOfGrains<Laws> spheres;
  ClumpMembers members;

  KOKKOS_FUNCTION void operator()(int clump, Real& shortest) const {
    TangentialSums all;
    const int begin = members.first(clump), head = members.entry(begin);
    const int count = spheres.shapes.count(spheres.kind.extent(0) > 0 ? spheres.kind(head) : 0);
    for (int p = begin; p < begin + count; ++p) {
      const TangentialSums of_one = spheres.contacts_of(members.entry(p), shortest);
      const Real share = spheres.spin_of(head) / spheres.spin_of(members.entry(p));
      all.stiffness += share * of_one.stiffness, all.damping += share * of_one.damping;
    }
    spheres.take_spin(all, head, shortest);
  }
};

}  // namespace barchan
