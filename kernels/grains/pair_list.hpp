// Pairs of grains that may touch.
#pragma once

#include <cstdint>

#include "kernels/grains/chunks.hpp"
#include "kernels/math/vec4.hpp"

namespace barchan {

/// Force of an inter-chunk pair in a grain step: one cache line, all zero while it does not touch.
struct alignas(64) PairForce {
  Vec4 force{};        // on the first grain [N], and the overlap [m]
  Vec4 n_cross_f_t{};  // n x F_t [N]
};

/// Half Verlet list with the contacts' history. Slots [0, n_inter) hold the pairs whose grains are
/// not of one chunk (ghosts are of none), the others those inside a chunk. Grain g is the first one
/// of its pairs in the slots [first(g), first(g+1)), inter-chunk, and [intra_first(g),
/// intra_first(g+1)), intra-chunk. It is the second one in the inter-chunk slots
/// incoming[incoming_first(g) .. incoming_first(g+1)).
struct PairList {
  Chunks chunks;
  int n_pairs = 0, n_inter = 0;
  Kokkos::View<int*> first, intra_first, incoming_first;  // (n + 1)
  Kokkos::View<int*> i, j;                                // (n_pairs)
  Kokkos::View<int*> incoming;                            // (n_inter)
  Kokkos::View<int*> active;    // (intra-chunk pairs) slots of a chunk's active pairs ...
  Kokkos::View<int*> n_active;  // (chunks) ... this many, from its first intra-chunk pair on
  Kokkos::View<Real*> slack;    // (n) distance that a grain may go before other pairs may touch [m]
  Kokkos::View<std::uint8_t*> expired;    // (chunks) 1: one of its grains has gone farther
  Kokkos::View<std::uint8_t*> near_wall;  // (n) 1: may touch a wall before then
  Kokkos::View<PairForce*> pair_force;    // (n_inter)
  Kokkos::View<Vec3*> xi_t;     // (n_pairs) tangential displacement of i relative to j [m]
  Kokkos::View<Vec3*> rolling;  // (n_pairs) rolling torque on i [N m]; empty without rolling
  Kokkos::View<Vec3*> force;    // (n_pairs) on i in the last grain step [N]; empty unless asked for
  Kokkos::View<std::uint8_t*> touching;  // (n_pairs) 1 while in contact
  Kokkos::View<std::uint8_t*> law;  // (n_pairs) entry in the table of laws; empty: all the same

  KOKKOS_FORCEINLINE_FUNCTION bool has_laws() const { return law.extent(0) > 0; }
  KOKKOS_FORCEINLINE_FUNCTION bool has_rolling() const { return rolling.extent(0) > 0; }
  KOKKOS_FORCEINLINE_FUNCTION bool has_force() const { return force.extent(0) > 0; }
};

}  // namespace barchan
