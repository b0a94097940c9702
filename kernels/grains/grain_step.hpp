// Grain step in one pass over the chunks of grains: forces of their intra-chunk pairs and of the
// walls, sum of all contacts, kick, and drift into the next grain step.
#pragma once

#include "kernels/grains/grain_motion.hpp"
#include "kernels/grains/pair_forces.hpp"
#include "kernels/grains/wall_contact.hpp"
#include "kernels/math/prefetch.hpp"

namespace barchan {

/// Adds the force of an inter-chunk pair to its first grain (sign 1) or second grain (-1).
template <bool rolls>
KOKKOS_FORCEINLINE_FUNCTION void add_pair_force(const PairList& list, int slot, Real sign,
                                                Real radius, ContactSum& sum) {
  const PairForce& pair = list.pair_force(slot);
  sum.force = fma(sign, pair.force, sum.force);
  sum.torque = fma(pair.force.w() / 2 - radius, pair.n_cross_f_t, sum.torque);
  if constexpr (rolls) sum.torque = fma(sign, vec4(list.rolling(slot)), sum.torque);
}

KOKKOS_FORCEINLINE_FUNCTION void fetch_pair_force(const PairList& list, int s) {
  if (s >= list.n_inter) return;
  prefetch(list.pair_force(list.incoming(s)));
  prefetch(list.j(list.incoming(s)));
}

/// Sums up the inter-chunk contacts of the entries [begin, end): first those of an entry's own
/// slots, then the others.
template <bool rolls>
KOKKOS_FORCEINLINE_FUNCTION void sum_inter_chunk(const PairList& list,
                                                 const Kokkos::View<GrainKinematics*>& grains,
                                                 int begin, int end, ContactSum* sums) {
  for (int g = begin; g < end; ++g) sums[place_in_chunk(g, begin)] = ContactSum{};
  for (int p = list.first(begin); p < list.first(end); ++p) {
    const int g = list.i(p);
    add_pair_force<rolls>(list, p, 1, grains(g).r, sums[place_in_chunk(g, begin)]);
  }
  for (int s = list.incoming_first(begin); s < list.incoming_first(end); ++s) {
    if constexpr (kOnHost) fetch_pair_force(list, s + 8);
    const int slot = list.incoming(s), g = list.j(slot);
    add_pair_force<rolls>(list, slot, -1, grains(g).r, sums[place_in_chunk(g, begin)]);
  }
}

/// Ends a grain step, a chunk of grains per index: new contact forces, second half kick, and unless
/// it is the last grain step the first half kick and drift of the next one. No grain of another
/// chunk is read, so chunks may go ahead of each other.
template <class Law>
struct SumKickDrift {
  GrainMotion motion;
  PairForces<Law> pairs;
  Walls<Law> walls;
  // contacts of each grain with bodies; empty: there are none
  Kokkos::View<const ContactSum*> of_bodies;
  Kokkos::View<Vec3*> contact_force, contact_torque;  // sums of the last grain step: [N], [N m]
  bool last = false;
  Real min_slack = 0;      // slack of a grain at rest [m]
  bool of_clumps = false;  // the sums are those of spheres of clumps, which MoveClumps moves

  KOKKOS_FUNCTION void operator()(int chunk, Real& largest) const {
    if (!pairs.validity.holds()) {  // closes the next grain step, too
      largest = Kokkos::Experimental::infinity_v<Real>;
      return;
    }
    const int begin = pairs.list.chunks.begin(chunk), end = pairs.list.chunks.end(chunk);
    ContactSum sums[kMaxChunk];
    sum_inter_chunk<Law::kRolls>(pairs.list, motion.grains, begin, end, sums);
    if constexpr (kOnHost) {
      if (pairs.list.expired(chunk)) find_active(chunk, begin, end);
      pairs.add_intra_chunk(chunk, sums);
    }
    const auto is_near = [&](int g) { return !kOnHost || pairs.list.near_wall(g) != 0; };
    walls.add(begin, end, is_near, sums);
    if (of_bodies.extent(0) > 0) add_bodies(begin, end, sums);
    if (last || of_clumps) keep(begin, end, sums);
    bool expired = false;
    if (of_clumps) {
      pairs.list.expired(chunk) = expired;
      return;
    }
    for (int g = begin; g < end; g += kTile) {
      const ContactSum* of_block = sums + place_in_chunk(g, begin);
      const bool is_expired = last ? motion.advance<Moves::out_of_last>(g, end, of_block, largest)
                                   : motion.advance<Moves::between>(g, end, of_block, largest);
      expired = expired || is_expired;
    }
    pairs.list.expired(chunk) = expired;
  }

  KOKKOS_FORCEINLINE_FUNCTION void add_bodies(int begin, int end, ContactSum* sums) const {
    for (int g = begin; g < end; ++g) {
      ContactSum& sum = sums[place_in_chunk(g, begin)];
      sum.force = sum.force + of_bodies(g).force;
      sum.torque = sum.torque + of_bodies(g).torque;
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void keep(int begin, int end, const ContactSum* sums) const {
    for (int g = begin; g < end; ++g) {
      contact_force(g) = sums[place_in_chunk(g, begin)].force.vec();
      contact_torque(g) = sums[place_in_chunk(g, begin)].torque.vec();
    }
  }

  /// Finds the pairs, and the grains beside walls, that can come into contact before a grain has
  /// used up its slack. The slack is the distance that a grain goes in the same time at its present
  /// speed, and a little more.
  KOKKOS_FORCEINLINE_FUNCTION void find_active(int chunk, int begin, int end) const {
    Real displacement = 0;  // sum of the displacements of the grains in a grain step [m]
    for (int g = begin; g < end; ++g) displacement += motion.dt * norm(motion.grains(g).u);
    const Real n_steps = steps_of_slack(displacement / (end - begin));
    for (int g = begin; g < end; ++g) {
      const Real slack = min_slack + n_steps * motion.dt * norm(motion.grains(g).u);
      pairs.list.slack(g) = slack;
      pairs.list.near_wall(g) = walls.is_near(g, slack);
    }
    pairs.find_active(chunk);
  }

  /// Number of grain steps for which slack is given. A search for active pairs costs once, more
  /// active pairs cost in every grain step, and their number grows with `displacement`, the mean
  /// one of a grain in a grain step [m]. Measured (docs/dev/performance.md); hardly anything
  /// changes from 20 to 200.
  KOKKOS_FORCEINLINE_FUNCTION Real steps_of_slack(Real displacement) const {
    const Real n_steps = Kokkos::sqrt(100 * min_slack / displacement);
    return n_steps < 100 ? n_steps : 100;
  }
};

}  // namespace barchan
