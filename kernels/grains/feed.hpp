// Grains that come in, and those that leave and come back.
#pragma once

#include <cstdint>

#include "kernels/grains/grain_sums.hpp"

namespace barchan {

/// A place for a grain: its centre and radius [m].
struct FeedPlace {
  Vec3 x;
  Real r = 0;
  /// Tells if a grain at this place would overlap another one, of centre b [m] and radius r_b [m].
  KOKKOS_FORCEINLINE_FUNCTION bool overlaps(const PeriodicBox& box, const Vec3& b, Real r_b) const {
    const Vec3 s = box.nearest_image(x - b);
    return dot(s, s) < (r + r_b) * (r + r_b);
  }
};

/// Marks the places that grain g overlaps.
struct MarkTakenPlaces {
  PeriodicBox box;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const FeedPlace*> places;
  int n_places;
  Kokkos::View<int*> taken;

  KOKKOS_FUNCTION void operator()(int g) const {
    for (int p = 0; p < n_places; ++p) {
      if (places(p).overlaps(box, grains(g).x, grains(g).r))
        Kokkos::atomic_store(&taken(p), 1);  // any thread writes the same value
    }
  }
};

/// A grain that leaves: number, radius [m], mass [kg], index of its kind. A clump has the radius of
/// the sphere of its volume.
struct LeavingGrain {
  Real id = 0, r = 0, m = 0, kind = 0;
};

/// Lists the grains that leave, in whatever order the threads come; `n` starts at zero. The first
/// sphere of a clump stands for all of it.
struct ListLeavingGrains {
  CountLeaving who;
  Kokkos::View<const std::int64_t*> id;
  Kokkos::View<const std::uint8_t*> kind;  // empty: one
  Kokkos::View<LeavingGrain*> leaving;
  Kokkos::View<int> n;

  KOKKOS_FUNCTION void operator()(int g) const {
    if (!who.leaves(g)) return;
    const auto& clump = who.place.clump;
    const bool of_clump = clump.extent(0) > 0;
    if (of_clump && member_of_id(id(g)) > 0) return;
    const GrainKinematics& k = who.place.grains(g);
    leaving(Kokkos::atomic_fetch_add(&n(), 1)) = {.id = static_cast<Real>(id(g)),
                                                  .r = of_clump ? clump(g).d / 2 : k.r,
                                                  .m = k.m,
                                                  .kind = kind.extent(0) > 0 ? kind(g) : Real(0)};
  }
};

}  // namespace barchan
