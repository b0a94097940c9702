// Rebuilds of the neighbour list with grains that leave or come in.
#include <type_traits>

#include "src/grains/grain_arrays.hpp"
#include "src/grains/neighbor_list.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

/// Makes entries for the new grains behind all others.
void NeighborList::append_new(GrainState& grains) {
  const int begin = grains.n, n = static_cast<int>(new_.size());
  const std::pair<int, int> entries(begin, begin + n);
  reserve_entries(grains, begin + n);
  for_each_grain_array(grains, kAnyUse, [&](const auto&, const auto& array) {
    using View = std::remove_cvref_t<decltype(array)>;
    const auto set_zero = [](const auto& part) {
      Kokkos::deep_copy(part, typename View::non_const_value_type{});
    };
    if constexpr (View::rank() == 2) set_zero(Kokkos::subview(array, entries, Kokkos::ALL()));
    if constexpr (View::rank() == 1) set_zero(Kokkos::subview(array, entries));
  });
  for (int q = 0; q < n; ++q) {
    const auto& [id, body, x, clump] = new_[static_cast<std::size_t>(q)];
    const auto set = [entry = begin + q](const auto& array, const auto& value) {
      if (array.size() > 0) Kokkos::deep_copy(Kokkos::subview(array, entry), value);
    };
    set(grains.kin, GrainKinematics{.x = x, .r = body.r, .u = {}, .m = body.m, .omega = {}});
    set(grains.id, id);
    set(grains.kind, static_cast<std::uint8_t>(body.kind));
    set(grains.heap, kNoHeap);
    set(grains.clump, clump);
  }
  grains.n += n;
}

void NeighborList::drop_left(GrainState& grains) {
  if (!leaves_x_) return;
  int n_leaving = 0;
  Kokkos::parallel_reduce("grains: count those that leave", grains.n, leaving(grains), n_leaving);
  if (sum_over(grains.ranks, std::int64_t{n_leaving}) > 0) rebuild(grains, true);
}

void NeighborList::bring_in(GrainState& grains, const std::vector<NewGrain>& come) {
  if (rank_of(grains.ranks) == 0) new_ = come;
  rebuild(grains, false);
  new_.clear();
}

}  // namespace barchan
