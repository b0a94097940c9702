// What a list rebuild does before it searches: grains in order, and the history of their contacts.
#include <fmt/format.h>

#include <Kokkos_Sort.hpp>
#include <string>

#include "src/base/errors.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/grains/list_memory.hpp"
#include "src/grains/neighbor_list.hpp"

namespace barchan {

void NeighborList::check_positions(const GrainState& grains) const {
  const auto kin = grains.kin;
  int bad = grains.n;
  Kokkos::parallel_reduce(
      "neighbors: find not-finite grain", grains.n,
      KOKKOS_LAMBDA(int g, int& first) {
        const Vec3& x = kin(g).x;
        if (!Kokkos::isfinite(x.x + x.y + x.z) && g < first) first = g;
      },
      Kokkos::Min<int>(bad));
  if (bad >= grains.n) return;
  std::int64_t id = 0;
  Kokkos::deep_copy(id, Kokkos::subview(grains.id, bad));
  Vec3 last;
  Kokkos::deep_copy(last, Kokkos::subview(grains.x_reference, bad));
  const std::string place = fmt::format(
      "; it was near ({:.6g}, {:.6g}, {:.6g}) m: time.grain_step may "
      "be too long, or grains overlapped at the start",
      last.x, last.y, last.z);
  throw StateError(
      fmt::format("the position of grain {} is not finite{}", id, rebuilds_ > 0 ? place : ""),
      ranks_ == nullptr);
}

void NeighborList::wrap(GrainState& grains) const {
  const auto kin = grains.kin;
  const PeriodicBox box = box_;
  Kokkos::parallel_for(
      "neighbors: wrap positions", grains.n,
      KOKKOS_LAMBDA(int g) { kin(g).x = box.wrap(kin(g).x); });
}

void NeighborList::sort(GrainState& grains, bool drop) {
  const int n = grains.n;
  reserve(row_, "row in the contact history", n + 1);
  reserve_room(n);
  const Kokkos::View<std::uint64_t*, Kokkos::MemoryUnmanaged> key(key_room_.data(),
                                                                  static_cast<std::size_t>(n));
  const auto row = Kokkos::subview(row_, std::pair<int, int>(0, n));
  const auto kin = grains.kin;
  const SearchColumns columns = columns_;
  const Real lx = lx_;
  const bool drops = drop && exit_x_;
  int n_dropped = 0;
  Kokkos::parallel_reduce(
      "neighbors: sort keys", n,
      KOKKOS_LAMBDA(int g, int& dropped) {
        const bool outside = drops && !(kin(g).x.x >= 0 && kin(g).x.x <= lx);
        key(g) = outside ? kDroppedKey : columns.key_of(kin(g).x);
        row(g) = g;
        dropped += outside ? 1 : 0;
      },
      n_dropped);
  Kokkos::Experimental::sort_by_key(Kokkos::DefaultExecutionSpace(), key, row);
  permute(grains, row, n - n_dropped, room_);
  grains.n_left += n_dropped;
}

void NeighborList::collect_history(const GrainState& grains) {
  const PairList& list = grains.list;
  const int n = grains.n;
  const GrainsWithHistory with_history{.list = list, .id = grains.id, .both = ranks_ != nullptr};
  take_scratch(idle_, history_.first, "contact history: first", n + 1);
  Kokkos::deep_copy(history_.first, 0);
  Kokkos::parallel_for("neighbors: count contacts", list.n_pairs,
                       CountContacts{.grains = with_history, .count = history_.first});
  const int n_contacts = counts_to_starts(history_.first, n);
  const auto take = [&](auto& array) { take_scratch(idle_, array, "contact history", n_contacts); };
  take(history_.partner), take(history_.xi_t);
  if (list.has_rolling()) take(history_.rolling);
  if (list.has_force()) take(history_.force);
  const auto rows = std::pair<int, int>(0, n);
  Kokkos::deep_copy(Kokkos::subview(row_, rows), Kokkos::subview(history_.first, rows));
  Kokkos::parallel_for(
      "neighbors: fill the contact history", list.n_pairs,
      FillContactHistory{.grains = with_history, .history = history_, .cursor = row_});
  has_history_ = true;
}

/// Grains to the ranks that own their columns, after new cuts where the work asks for them.
void NeighborList::redistribute(GrainState& grains) {
  if (!has_history_) history_.first = Kokkos::View<int*>("contact history: first", grains.n + 1);
  ranks_->partition.balance(grains, columns_, history_.first);
  columns_.origin = ranks_->partition.origin();
  ranks_->migrate(grains, history_, columns_, ranks_->partition.owners(), room_);
}

}  // namespace barchan
