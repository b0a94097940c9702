#include "src/grains/clump_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/base/errors.hpp"
#include "src/grains/list_memory.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/sort.hpp"

namespace barchan {

using Entries = Kokkos::View<int*>;
using Keys = Kokkos::View<std::uint64_t*>;

namespace {

template <class View>
View first_of(const View& values, int n) {
  return Kokkos::subview(values, std::pair<int, int>(0, n));
}

}  // namespace

void check_motions(const GrainState& grains) {
  const auto clump = grains.clump;
  int n_missing = 0;
  Kokkos::parallel_reduce(
      "clumps: entries without motion", items(grains.n),
      KOKKOS_LAMBDA(int g, int& missing) { missing += clump(g).m > 0 ? 0 : 1; }, n_missing);
  if (n_missing == 0) return;
  throw std::logic_error(
      fmt::format("{} of {} grains are not spheres of a clump, and the case has clumps: its grains "
                  "must go through as_spheres()",
                  n_missing, grains.n));
}

void find_members(GrainState& grains, const Keys& room) {
  const int n = grains.n;
  ClumpMembers& members = grains.members;
  reserve(members.entry, "clumps: entries", n);
  reserve(members.first, "clumps: first", n);
  const Keys key = first_of(room, n);
  const Entries entry = first_of(members.entry, n), begin = members.first;
  const auto id = grains.id;
  Kokkos::parallel_for(
      "clumps: keys", items(n), KOKKOS_LAMBDA(int g) {
        key(g) = (static_cast<std::uint64_t>(clump_of_id(id(g))) << 16) |
                 static_cast<std::uint64_t>(member_of_id(id(g)));
        entry(g) = g;
      });
  sort_by_key(key, entry);
  const auto place = used_as<Entries>(Kokkos::subview(room, std::pair<int, int>(n, 2 * n)), n);
  Kokkos::parallel_for(
      "clumps: places", items(n), KOKKOS_LAMBDA(int p) { place(entry(p)) = p; });
  // Spheres stand one after the other, as many as the kind of the first one has.
  const ClumpShapes shapes = grains.shapes;
  const auto kind = grains.kind;
  int n_in_clumps = 0;
  Kokkos::parallel_reduce(
      "clumps: whole ones", items(n),
      KOKKOS_LAMBDA(int p, int& sum) {
        const int first = entry(p);
        if (member_of_id(id(first)) != 0) return;
        const int k = kind.extent(0) > 0 ? kind(first) : 0;
        const int count = k < kMaxKinds ? shapes.count(k) : 0;  // a file may hold anything
        bool whole = p + count <= n;
        for (int member = 0; whole && member < count; ++member)
          whole = id(entry(p + member)) == id_of_member(id(first), member);
        sum += whole ? count : 0;
      },
      n_in_clumps);
  if (n_in_clumps != n) {
    throw StateError(fmt::format("{} of {} spheres of clumps are not with the rest of their clump",
                                 n - n_in_clumps, n),
                     rank_count(grains.ranks) == 1);
  }
  members.n = scan(
      "clumps: numbers", items(n), KOKKOS_LAMBDA(int g, int& count, bool final) {
        if (member_of_id(id(g)) != 0) return;
        if (final) begin(count) = place(g);
        ++count;
      });
}

int clumps_in(const GrainState& grains, const Kokkos::View<const std::uint64_t*>& key) {
  const auto id = grains.id;
  int clumps = 0;
  Kokkos::parallel_reduce(
      "clumps: count those that leave", items(grains.n),
      KOKKOS_LAMBDA(int g, int& count) {
        count += key(g) == kDroppedKey && member_of_id(id(g)) == 0 ? 1 : 0;
      },
      clumps);
  return clumps;
}

void find_order(const GrainState& grains, const SearchColumns& columns, const Keys& room,
                OrderOfPlaces& order) {
  const int n = grains.n + grains.n_ghosts;
  reserve(order.entry, "clumps: entries of places", n);
  reserve(order.grains, "clumps: in order", n);
  const Keys key = first_of(room, n);
  const Entries entry = first_of(order.entry, n);
  const auto kin = grains.kin;
  const auto id = grains.id;
  Kokkos::parallel_for(
      "clumps: keys of columns", items(n), KOKKOS_LAMBDA(int g) {
        key(g) = columns.key_of(kin(g).x);
        entry(g) = g;
      });
  sort_by_key(key, entry);
  Kokkos::parallel_for(
      "clumps: equal keys by ids", items(n), KOKKOS_LAMBDA(int p) {
        if (p > 0 && key(p - 1) == key(p)) return;  // the first of some does it for all
        for (int a = p + 1; a < n && key(a) == key(p); ++a) {
          const int one = entry(a);
          int b = a;
          for (; b > p && id(entry(b - 1)) > id(one); --b) entry(b) = entry(b - 1);
          entry(b) = one;
        }
      });
  const auto ordered = order.grains;
  Kokkos::parallel_for(
      "clumps: in order", items(n), KOKKOS_LAMBDA(int p) { ordered(p) = kin(entry(p)); });
}

int columns_of_arm(const LongestArm& arm, const SearchColumns& columns) {
  const Real narrowest = 1 / std::max(columns.inverse_width_x, columns.inverse_width_z);
  const Real crossed = std::ceil(arm.length / narrowest);
  if (crossed > kMostArms) {
    throw InputError(
        fmt::format("{} makes clumps with a sphere {:.3g} m from their centre, too far for several "
                    "ranks: at most {:.3g} m with spheres this small; take --ranks 1, or rounder "
                    "clumps",
                    arm.key, arm.length, kMostArms * narrowest));
  }
  return static_cast<int>(crossed);
}

}  // namespace barchan
