// Search for the pairs of a neighbour list.
#include "src/grains/clump_members.hpp"
#include "src/grains/list_memory.hpp"
#include "src/grains/neighbor_list.hpp"
#include "src/grains/pair_slots.hpp"

namespace barchan {

/// Counts the pairs that a search finds, makes room for them and writes them.
template <class Finder>
void NeighborList::find_pairs(GrainState& grains, const Finder& search) {
  const int n = grains.n + grains.n_ghosts;
  PairList& list = grains.list;
  const auto noted = used_as<NotedPartners>(grain_memory_, n);
  Kokkos::parallel_for("neighbors: count", n,
                       CountPairs<Finder>{.search = search,
                                          .chunks = list.chunks,
                                          .inter = list.first,
                                          .intra = list.intra_first,
                                          .noted = noted});
  list.n_inter = counts_to_offsets(list.first, n);
  list.n_pairs = counts_to_offsets(list.intra_first, n, list.n_inter);
  reserve_pairs(list);
  Kokkos::parallel_for("neighbors: fill", n,
                       FillPairs<Finder>{.search = search,
                                         .noted = noted,
                                         .list = list,
                                         .history = history_,
                                         .old_entry = entry_,
                                         .id = grains.id,
                                         .kind = grains.kind,
                                         .has_history = has_history_});
}

void NeighborList::search(GrainState& grains) {
  const int n = grains.n + grains.n_ghosts;
  reserve_memory(n);
  const bool has_clumps = grains.clump.size() > 0;
  const bool ranks_agree = has_clumps && ranks_;
  if (ranks_agree) find_order(grains, columns_, key_memory_, order_);
  const OrderOfPlaces order = ranks_agree ? order_ : OrderOfPlaces{.grains = grains.kin};
  const Windows window = find_windows(order.grains, n);
  PairList& list = grains.list;
  list.chunks = make_chunks(grains.n);
  reserve(list.first, "pairs: first", n + 1);
  reserve(list.intra_first, "pairs: first intra-chunk", n + 1);
  reserve(list.incoming_first, "pairs: incoming first", n + 1);
  reserve(list.near_wall, "near a wall", grains.n);
  static_assert(kNoted * sizeof(int) == sizeof(Vec4));
  const PairSearch pair_search{.columns = columns_,
                               .grains = order.grains,
                               .occupied = occupied_,
                               .window = window,
                               .box = box_,
                               .n_owned = has_clumps ? n : grains.n};
  if (has_clumps) {
    find_pairs(grains, ClumpPairSearch{.places = pair_search,
                                       .entry_of_place = order.entry,
                                       .id = grains.id,
                                       .n_owned = grains.n});
  } else {
    find_pairs(grains, pair_search);
  }
  has_history_ = false;
  register_second_grains(list, n, used_as<Kokkos::View<int*>>(key_memory_, n));
}

}  // namespace barchan
