// Normal and tangential parts of the contact forces of one grain, for output.
#pragma once

#include "kernels/grain.hpp"
#include "kernels/wall_contact.hpp"

namespace barchan {

/// Splits contact_force(g) [N] of the last sub-step. Pairs: F_t = -n x (n x F_t), with n from the
/// positions, which have not changed since. Walls: what is left over the pairs, along and across
/// the normal of the first wall that the grain touches.
struct SplitContacts {
  PeriodicBox box;
  PairList list;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const Vec3*> contact_force;
  Kokkos::View<const std::uint8_t*> wall_touching;
  Plane plane[kMaxWalls];
  Kokkos::View<Vec3*> normal, tangential;  // results [N]

  KOKKOS_FUNCTION Vec3 tangential_of(int slot) const {
    const Vec3 s = box.nearest_image(grains(list.i(slot)).x - grains(list.j(slot)).x);
    return -cross((1 / norm(s)) * s, list.line(slot).twist);
  }
  KOKKOS_FUNCTION void operator()(int g) const {
    Vec3 pairs, pairs_tangential;
    for (int p = list.first(g); p < list.first(g + 1); ++p) {
      pairs += list.line(p).force;
      pairs_tangential += tangential_of(p);
    }
    for (int s = list.other_first(g); s < list.other_first(g + 1); ++s) {
      pairs += -list.line(list.other_slot(s)).force;
      pairs_tangential += -tangential_of(list.other_slot(s));
    }
    const Vec3 wall = contact_force(g) - pairs;
    Vec3 wall_normal;
    for (int w = kMaxWalls - 1; w >= 0; --w) {
      if (wall_touching(g) >> w & 1) wall_normal = dot(wall, plane[w].normal) * plane[w].normal;
    }
    tangential(g) = pairs_tangential + (wall - wall_normal);
    normal(g) = contact_force(g) - tangential(g);
  }
};

}  // namespace barchan
