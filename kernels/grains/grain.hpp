// A grain as a sphere and as its neighbours see it, and the pairs it may touch.
#pragma once

#include <cstdint>
#include <numbers>

#include "kernels/math/vec4.hpp"

namespace barchan {

/// Volume of a sphere [m^3]; radius [m].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_volume(Real radius) {
  return Real(4) / 3 * std::numbers::pi_v<Real> * radius * radius * radius;
}
static_assert(sphere_volume(0.5) > 0.523598 && sphere_volume(0.5) < 0.523599);  // pi d^3 / 6

/// Moment of inertia of a solid sphere about its centre, 2/5 m r^2 [kg m^2].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_inertia(Real mass, Real radius) {
  return Real(0.4) * mass * radius * radius;
}

/// What a contact needs of one grain, side by side in memory: two cache lines per neighbour
/// instead of eleven.
struct alignas(32) GrainKinematics {
  Vec3 x;         // centre [m]
  Real r = 0;     // radius [m]
  Vec3 u;         // velocity [m/s]
  Real m = 0;     // mass [kg]
  Vec3 omega;     // angular velocity [rad/s]
  Real skin = 0;  // distance that it may move until the neighbour list is searched again [m]

  KOKKOS_FORCEINLINE_FUNCTION Vec4 x_r() const { return {x.x, x.y, x.z, r}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec4 u_m() const { return {u.x, u.y, u.z, m}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec4 omega_skin() const { return {omega.x, omega.y, omega.z, skin}; }
};

/// Asks the caches of a CPU for something that is needed soon.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void prefetch([[maybe_unused]] const T& a) {
  KOKKOS_IF_ON_HOST((const char* begin = reinterpret_cast<const char*>(&a);
                     for (std::size_t line = 0; line < sizeof(T); line += 64)
                         __builtin_prefetch(begin + line);))
}

/// Squared displacement since the list was searched beyond the square of a grain's skin [m^2]; what
/// is not a number counts as infinitely far: the next rebuild meets and reports it.
KOKKOS_FORCEINLINE_FUNCTION Real excess_over_skin(const Vec3& displacement, Real skin) {
  const Real excess = dot(displacement, displacement) - skin * skin;
  return excess == excess ? excess : Kokkos::Experimental::infinity_v<Real>;
}

/// Lets a grain step go ahead while no grain has moved farther than its skin. A host that waits for
/// a device only now and then launches grain steps ahead of that knowledge; those behind a stale
/// list then do nothing.
struct ListValidity {
  Kokkos::View<const Real*> excess;  // largest of all grains [m^2] ...
  int before = 0;                    // ... as this grain step begins: in this element
  KOKKOS_FORCEINLINE_FUNCTION bool holds() const { return excess(before) <= 0; }
};

/// Sum of the contact forces [N] and torques [N m] on a grain.
struct ContactSum {
  Vec4 force, torque;
};

/// Most entries of a chunk: on a CPU they stay in its L2 cache, on a GPU every entry is a chunk.
inline constexpr int kMaxChunk =
    Kokkos::SpaceAccessibility<Kokkos::HostSpace,
                               Kokkos::DefaultExecutionSpace::memory_space>::accessible
        ? 4096
        : 1;

/// The grains in chunks of consecutive entries, each of which one thread takes at a time. Their
/// size depends on the number of grains alone, so that results do not depend on the number of
/// threads.
struct Chunks {
  int n = 0, size = 1;

  KOKKOS_FORCEINLINE_FUNCTION int count() const { return (n + size - 1) / size; }
  /// Two entries of one chunk; entries from n on are in none.
  KOKKOS_FORCEINLINE_FUNCTION bool contain_both(int a, int b) const {
    return a < n && b < n && a / size == b / size;
  }
  KOKKOS_FORCEINLINE_FUNCTION int begin(int chunk) const { return chunk * size; }
  KOKKOS_FORCEINLINE_FUNCTION int end(int chunk) const {
    return (chunk + 1) * size < n ? (chunk + 1) * size : n;
  }
};
/// Place of an entry in its chunk: a constant where every entry is one, so that a device keeps what
/// lies there in registers.
KOKKOS_FORCEINLINE_FUNCTION constexpr int place_in_chunk(int entry, int begin) {
  return kMaxChunk > 1 ? entry - begin : 0;
}
/// Large chunks have few pairs that cross; a multiple of eight of them shares well among threads,
/// unless that makes them tiny.
inline Chunks make_chunks(int n) {
  const int count = 8 * ((n + 8 * kMaxChunk - 1) / (8 * kMaxChunk));
  const int size = count > 0 ? (n + count - 1) / count : 1;
  const int least = kMaxChunk < 256 ? kMaxChunk : 256;
  return {.n = n, .size = size < least ? least : size};
}

/// What an inter-chunk pair does to its grains in a grain step: one cache line, all zero while it
/// does not touch.
struct alignas(64) PairForce {
  Vec4 force{};        // on the first grain [N], and the overlap [m]
  Vec4 n_cross_f_t{};  // n x F_t [N]
};

/// Half Verlet list with the contacts' history. Slots [0, n_inter) hold the pairs whose grains
/// are not of one chunk (ghosts are of none), the others those inside a chunk. Grain g is the first
/// one of its pairs in the slots [first(g), first(g+1)), inter-chunk, and [intra_first(g),
/// intra_first(g+1)), intra-chunk; it is the second one in the inter-chunk slots
/// incoming[incoming_first(g)
/// .. incoming_first(g+1)).
struct PairList {
  Chunks chunks;
  int n_pairs = 0, n_inter = 0;
  Kokkos::View<int*> first, intra_first, incoming_first;  // (n + 1)
  Kokkos::View<int*> i, j;                                // (n_pairs)
  Kokkos::View<int*> incoming;                            // (n_inter)
  Kokkos::View<int*> active;    // (intra-chunk pairs) slots of a chunk's active pairs ...
  Kokkos::View<int*> n_active;  // (chunks) ... this many, from its first intra-chunk pair on
  Kokkos::View<Real*> slack;    // (n) how far a grain may still go until other pairs may touch [m]
  Kokkos::View<std::uint8_t*> expired;    // (chunks) 1: one of its grains has gone farther
  Kokkos::View<std::uint8_t*> near_wall;  // (n) 1: may touch a wall until then
  Kokkos::View<PairForce*> pair_force;    // (n_inter)
  Kokkos::View<Vec3*> xi_t;     // (n_pairs) tangential displacement of i relative to j [m]
  Kokkos::View<Vec3*> rolling;  // (n_pairs) rolling torque on i [N m]; empty without rolling
  Kokkos::View<Vec3*> force;    // (n_pairs) on i in the last grain step [N]; empty unless asked for
  Kokkos::View<std::uint8_t*> touching;  // (n_pairs) 1 while in contact

  KOKKOS_FORCEINLINE_FUNCTION bool has_rolling() const { return rolling.extent(0) > 0; }
  KOKKOS_FORCEINLINE_FUNCTION bool has_force() const { return force.extent(0) > 0; }
};

}  // namespace barchan
