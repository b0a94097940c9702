#include "src/grains/ghost_grains.hpp"

#include <utility>

#include "src/grains/grain_arrays.hpp"
#include "src/grains/list_memory.hpp"
#include "src/parallel/sort.hpp"

namespace barchan {

using Entries = Kokkos::View<int*>;

/// Chooses the grains to send: fills sent_entry_ and counts_.
void GhostGrains::choose(const GrainState& grains, const SearchColumns& columns,
                         const GrainOwners& owners) {
  const auto kin = grains.kin;
  const int n = grains.n;
  const auto first = uninitialized<Entries>("ghosts: first copy", n + 1);
  Kokkos::parallel_for(
      "ghosts: count copies", items(n),
      KOKKOS_LAMBDA(int g) { first(g) = GhostDestinations(columns, owners, kin(g).x).n; });
  const int n_copies = counts_to_offsets(first, n);
  const auto rank = uninitialized<Entries>("ghosts: rank", n_copies);
  const auto entry = uninitialized<Entries>("ghosts: entry", n_copies);
  Kokkos::parallel_for(
      "ghosts: list copies", items(n), KOKKOS_LAMBDA(int g) {
        if (first(g) == first(g + 1)) return;
        const GhostDestinations destinations(columns, owners, kin(g).x);
        for (int q = 0; q < destinations.n; ++q) {
          rank(first(g) + q) = destinations.rank[q];
          entry(first(g) + q) = g;
        }
      });
  SendList copies = sort_by_rank(rank, n_copies, owners.start.extent_int(0));
  sent_entry_ = copies.entry;
  const auto sent = sent_entry_;
  Kokkos::parallel_for(
      "ghosts: entries to send", items(n_copies),
      KOKKOS_LAMBDA(int p) { sent(p) = entry(sent(p)); });
  counts_ = exchange_counts(grains.ranks, std::move(copies.to));
}

/// Unpacks received ghosts into the entries after the owned ones, in the order of the columns.
void GhostGrains::unpack(GrainState& grains, const SearchColumns& columns) {
  const int n = grains.n, n_ghosts = count();
  grains.n_ghosts = n_ghosts;
  reserve_entries(grains, n + n_ghosts, kGhosts);
  const auto key = uninitialized<Kokkos::View<std::uint64_t*>>("ghosts: key", n_ghosts);
  const auto order = uninitialized<Entries>("ghosts: order", n_ghosts);
  const PackLayout layout = layout_of(grains, kGhosts);
  const Real* const received = exchange_.received() + layout.offset_of(grains.kin.data());
  const int width = exchange_.width();
  Kokkos::parallel_for(
      "ghosts: keys", items(n_ghosts), KOKKOS_LAMBDA(int p) {
        const Real* x = received + std::ptrdiff_t{width} * p;
        key(p) = columns.key_of({x[0], x[1], x[2]});
        order(p) = p;
      });
  sort_by_key(key, order);
  entry_ = uninitialized<Entries>("ghosts: entry", n_ghosts);
  const auto entry = entry_;
  Kokkos::parallel_for(
      "ghosts: entries", items(n_ghosts), KOKKOS_LAMBDA(int q) { entry(order(q)) = n + q; });
  exchange_.unpack(layout, entry_);
}

void GhostGrains::find(GrainState& grains, const SearchColumns& columns,
                       const GrainOwners& owners) {
  choose(grains, columns, owners);
  exchange_.exchange(counts_, layout_of(grains, kGhosts), sent_entry_);
  unpack(grains, columns);
}

void GhostGrains::update(const Kokkos::View<GrainKinematics*>& kin) {
  PackLayout motion;
  motion.add(kin, &GrainKinematics::x);
  motion.add(kin, &GrainKinematics::u);
  motion.add(kin, &GrainKinematics::omega);
  exchange_.exchange(counts_, motion, sent_entry_);
  exchange_.unpack(motion, entry_);
}

}  // namespace barchan
