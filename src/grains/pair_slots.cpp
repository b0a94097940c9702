#include "src/grains/pair_slots.hpp"

#include <utility>

#include "kernels/grains/neighbor_search.hpp"
#include "src/grains/list_memory.hpp"

namespace barchan {

void register_second_grains(const PairList& list, int n, const Kokkos::View<int*>& cursor) {
  Kokkos::deep_copy(list.incoming_first, 0);
  Kokkos::parallel_for(
      "neighbors: count incoming", list.n_inter,
      KOKKOS_LAMBDA(int slot) { Kokkos::atomic_inc(&list.incoming_first(list.j(slot))); });
  counts_to_offsets(list.incoming_first, n);
  Kokkos::deep_copy(cursor, Kokkos::subview(list.incoming_first, std::pair<int, int>(0, n)));
  Kokkos::parallel_for("neighbors: fill incoming", list.n_inter,
                       FillIncoming{.list = list, .cursor = cursor});
  Kokkos::parallel_for("neighbors: sort incoming", n, SortIncoming{.list = list});
}

}  // namespace barchan
