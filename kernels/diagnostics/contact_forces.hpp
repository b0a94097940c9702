// Contact forces of each grain by normal and tangential part, for output.
#pragma once

#include "kernels/bodies/body.hpp"
#include "kernels/grains/grain.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {

/// Splits contact_force(g) [N] of the last grain step. Pairs: F_t = F - (F.n) n, with n from the
/// positions, which have not changed since. Walls and bodies: the rest, along
/// and across the normal of the first wall that the grain touches, or else of the first body.
struct SplitContacts {
  PeriodicBox box;
  PairList list;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const Vec3*> contact_force;
  Kokkos::View<const std::uint8_t*> wall_touching;
  WallShapes walls;
  Kokkos::View<const std::uint8_t*> body_touching;  // empty: there are no bodies
  Bodies bodies;
  Kokkos::View<Vec3*> normal, tangential;  // results [N]

  /// Takes the force of one pair into the sums that `normal` (all of it) and `tangential` hold.
  KOKKOS_FUNCTION void add(int g, int slot, Real sign) const {
    if (!list.touching(slot)) return;  // its force may be of an earlier touch
    const Vec3 force = list.force(slot);
    const Vec3 s = box.nearest_image(grains(list.i(slot)).x - grains(list.j(slot)).x);
    const Vec3 n = (1 / norm(s)) * s;
    normal(g) += sign * force;
    tangential(g) += sign * (force - dot(force, n) * n);
  }
  KOKKOS_FUNCTION void operator()(int chunk) const {
    const int begin = list.chunks.begin(chunk), end = list.chunks.end(chunk);
    for (int g = begin; g < end; ++g) {
      normal(g) = tangential(g) = Vec3{};
      for (int p = list.first(g); p < list.first(g + 1); ++p) add(g, p, 1);
      for (int s = list.incoming_first(g); s < list.incoming_first(g + 1); ++s) {
        add(g, list.incoming(s), -1);
      }
    }
    for (int p = list.intra_first(begin); p < list.intra_first(end); ++p) {
      add(list.i(p), p, 1);
      add(list.j(p), p, -1);
    }
    for (int g = begin; g < end; ++g) split_walls(g);
  }
  KOKKOS_FUNCTION void split_walls(int g) const {
    const Vec3 wall = contact_force(g) - normal(g);
    Vec3 wall_normal;
    for (int b = bodies.n - 1; b >= 0; --b) {
      if (!(body_touching(g) >> b & 1)) continue;
      const Vec3 n = bodies.body[b].to_surface(grains(g).x).normal;
      wall_normal = dot(wall, n) * n;
    }
    for (int w = kMaxWalls - 1; w >= 0; --w) {
      if (!(wall_touching(g) >> w & 1)) continue;
      const Vec3 n = walls.at(w, grains(g).x).normal;
      wall_normal = dot(wall, n) * n;
    }
    tangential(g) += wall - wall_normal;
    normal(g) = contact_force(g) - tangential(g);
  }
};

}  // namespace barchan
