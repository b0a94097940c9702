#include "src/grains/neighbor_list.hpp"

#include <fmt/format.h>

#include <Kokkos_Profiling_ScopedRegion.hpp>
#include <Kokkos_Sort.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "src/base/errors.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

int column_count(Real extent, Real cutoff, bool periodic, const char* axis) {
  const int n = std::clamp(static_cast<int>(std::floor(extent / cutoff)), 1, kMaxColumns);
  if (periodic && n < 3) {
    throw std::runtime_error(std::string("the domain is too narrow along ") + axis +
                             " for periodic grains: it must be at least three contact ranges (" +
                             std::to_string(3 * cutoff) + " m) wide");
  }
  return n;
}

/// n entries, or a few, and a sixteenth more.
std::size_t with_slack(int n) {
  return static_cast<std::size_t>(n) + static_cast<std::size_t>(n / 16) + 64;
}

/// Room for n entries, kept between rebuilds; grows by more than asked.
template <class View>
void reserve(View& view, const char* label, int n) {
  if (static_cast<int>(view.extent(0)) < std::max(n, 1)) {
    view = View(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), with_slack(n));
  }
}

/// Turns counts in [0, n) into starts from `begin` on, the end at n. Returns the end.
int counts_to_starts(const Kokkos::View<int*>& a, int n, int begin = 0) {
  int total = 0;
  Kokkos::parallel_scan(
      "neighbors: prefix sum", n,
      KOKKOS_LAMBDA(int i, int& sum, bool final) {
        const int count = a(i);
        if (final) a(i) = begin + sum;
        sum += count;
      },
      total);
  Kokkos::deep_copy(Kokkos::subview(a, n), begin + total);
  return begin + total;
}

}  // namespace

NeighborList::NeighborList(const Config& config, Real r_max, MPI_Comm ranks)
    : skin_(config.grains->skin),
      r_max_(r_max),
      lx_(config.size[0]),
      ly_(config.size[1]),
      lz_(config.size[2]),
      exit_x_(config.grains->boundary_x == GrainBoundaryX::exit) {
  const Real cutoff = 2 * r_max + skin_;
  columns_.periodic_x = config.grains->boundary_x == GrainBoundaryX::periodic;
  columns_.periodic_z = config.grains->boundary_z == GrainBoundaryZ::periodic;
  columns_.nx = column_count(lx_, cutoff, columns_.periodic_x, "x");
  columns_.nz = column_count(lz_, cutoff, columns_.periodic_z, "z");
  columns_.inverse_width_x = columns_.nx / lx_;
  columns_.inverse_width_z = columns_.nz / lz_;
  columns_.height = ly_;
  box_.lx = columns_.periodic_x ? lx_ : 0;
  box_.lz = columns_.periodic_z ? lz_ : 0;
  if (rank_count(ranks) > 1) ranks_ = std::make_unique<Ranks>(ranks);
}

/// Idle memory if there is enough, else as reserve() does.
template <class T>
void NeighborList::take_scratch(Kokkos::View<T*>& view, const char* label, int n) {
  const auto idle = idle_.take<T>(with_slack(n));
  if (idle.extent(0) > 0) {
    view = idle;
    return;
  }
  if (view.use_count() == 0) view = {};  // idle memory of an earlier rebuild
  reserve(view, label, n);
}

void NeighborList::take_room(const GrainState& grains) {
  idle_.free_all();
  const int n = grains.n + grains.n_ghosts;
  take_scratch(row_, "row in the contacts kept", n + 1);
  take_scratch(room_, "room of a rebuild", n);
  take_scratch(key_room_, "keys of a rebuild", 2 * n);
  take_scratch(occupied_.of_grain, "column of grain", n);
}

/// Those that came from other ranks, and ghosts, may need more.
void NeighborList::reserve_room(int n) {
  reserve(room_, "room of a rebuild", n);
  reserve(key_room_, "keys of a rebuild", 2 * n);
  reserve(occupied_.of_grain, "column of grain", n);
}

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
  reserve(row_, "row in the contacts kept", n + 1);
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

Windows NeighborList::find_windows(const Kokkos::View<const GrainKinematics*>& kin, int n) {
  const NumberColumns find{.columns = columns_, .grains = kin, .occupied = occupied_};
  Kokkos::parallel_scan("neighbors: occupied columns", n, find, occupied_.n);
  reserve(occupied_.id, "occupied columns", occupied_.n);
  reserve(occupied_.start, "column starts", occupied_.n + 1);
  Kokkos::parallel_for("neighbors: column starts", n,
                       StartColumns{.columns = columns_, .grains = kin, .occupied = occupied_});
  Kokkos::deep_copy(Kokkos::subview(occupied_.start, occupied_.n), n);
  reserve(occupied_.forward, "forward columns", occupied_.n);
  Kokkos::parallel_for("neighbors: link columns", occupied_.n,
                       LinkColumns{.columns = columns_, .occupied = occupied_});
  static_assert(kForwardColumns * sizeof(int) == 2 * sizeof(std::uint64_t));
  const Windows window(reinterpret_cast<int*>(key_room_.data()), static_cast<std::size_t>(n));
  Kokkos::parallel_for(
      "neighbors: windows", occupied_.n,
      FindWindows{
          .grains = kin, .occupied = occupied_, .window = window, .reach = 2 * r_max_ + skin_});
  return window;
}

void NeighborList::keep_contacts(const GrainState& grains) {
  const PairList& list = grains.list;
  const int n = grains.n;
  const KeepingGrains keeping{.list = list, .id = grains.id, .both = ranks_ != nullptr};
  take_scratch(kept_.first, "contact history: first", n + 1);
  Kokkos::deep_copy(kept_.first, 0);
  Kokkos::parallel_for("neighbors: count contacts", list.n_pairs,
                       CountContacts{.keeping = keeping, .count = kept_.first});
  const int n_contacts = counts_to_starts(kept_.first, n);
  take_scratch(kept_.partner, "contact history: partner", n_contacts);
  take_scratch(kept_.xi_t, "contact history: xi_t", n_contacts);
  if (list.has_rolling()) take_scratch(kept_.rolling, "contact history: rolling", n_contacts);
  if (list.has_force()) take_scratch(kept_.force, "contact history: force", n_contacts);
  const auto rows = std::pair<int, int>(0, n);
  Kokkos::deep_copy(Kokkos::subview(row_, rows), Kokkos::subview(kept_.first, rows));
  Kokkos::parallel_for("neighbors: keep contacts", list.n_pairs,
                       KeepContacts{.keeping = keeping, .kept = kept_, .cursor = row_});
  has_kept_ = true;
}

/// Grains to the ranks that own their columns, after new cuts where the work asks for them.
void NeighborList::redistribute(GrainState& grains) {
  if (!has_kept_) kept_.first = Kokkos::View<int*>("contact history: first", grains.n + 1);
  ranks_->partition.balance(grains, columns_, kept_.first);
  columns_.origin = ranks_->partition.origin();
  ranks_->migrate(grains, kept_, columns_, ranks_->partition.owners(), room_);
}

void NeighborList::reserve_pairs(PairList& list) const {
  reserve(list.i, "pairs: i", list.n_pairs);
  reserve(list.j, "pairs: j", list.n_pairs);
  reserve(list.other_slot, "pairs: other slot", list.n_crossing);
  reserve(list.pair_force, "pairs: force of a crossing pair", list.n_crossing);
  reserve(list.active, "pairs: active", list.n_pairs - list.n_crossing + 1);
  reserve(list.n_active, "chunks: active pairs", list.chunks.count());
  reserve(list.slack, "chunks: slack", list.chunks.count());
  Kokkos::deep_copy(list.slack, -1.0);
  reserve(list.margin, "chunks: margin", list.chunks.count());
  Kokkos::deep_copy(list.margin, largest_margin());
  reserve(list.xi_t, "pairs: xi_t", list.n_pairs);
  reserve(list.touching, "pairs: touching", list.n_pairs);
  if (with_rolling) reserve(list.rolling, "pairs: rolling", list.n_pairs);
  if (with_force) reserve(list.force, "pairs: force", list.n_pairs);
}

void NeighborList::register_others(const PairList& list, int n) {
  Kokkos::deep_copy(list.other_first, 0);
  Kokkos::parallel_for(
      "neighbors: count others", list.n_crossing,
      KOKKOS_LAMBDA(int slot) { Kokkos::atomic_inc(&list.other_first(list.j(slot))); });
  counts_to_starts(list.other_first, n);
  const Kokkos::View<int*> cursor(reinterpret_cast<int*>(key_room_.data()),
                                  static_cast<std::size_t>(n));
  Kokkos::deep_copy(cursor, Kokkos::subview(list.other_first, std::pair<int, int>(0, n)));
  Kokkos::parallel_for("neighbors: register others", list.n_crossing,
                       RegisterOthers{.list = list, .cursor = cursor});
  Kokkos::parallel_for("neighbors: sort others", n, SortOthers{.list = list});
}

void NeighborList::search(GrainState& grains, const Kokkos::View<const GrainKinematics*>& kin) {
  const int n = grains.n + grains.n_ghosts;
  reserve_room(n);
  const Windows window = find_windows(kin, n);
  PairList& list = grains.list;
  list.chunks = make_chunks(grains.n);
  reserve(list.first, "pairs: first", n + 1);
  reserve(list.inner_first, "pairs: inner first", n + 1);
  reserve(list.other_first, "pairs: other first", n + 1);
  reserve(list.near_wall, "near a wall", grains.n);
  static_assert(kNoted * sizeof(int) == sizeof(Quad));
  const NotedPartners noted(reinterpret_cast<int*>(room_.data()), static_cast<std::size_t>(n));
  const PairSearch pair_search{.grains = kin,
                               .occupied = occupied_,
                               .window = window,
                               .box = box_,
                               .skin = skin_,
                               .r_max = r_max_,
                               .n_owned = grains.n};
  Kokkos::parallel_for("neighbors: count", n,
                       CountPairs{.search = pair_search,
                                  .chunks = list.chunks,
                                  .crossing = list.first,
                                  .inner = list.inner_first,
                                  .noted = noted});
  list.n_crossing = counts_to_starts(list.first, n);
  list.n_pairs = counts_to_starts(list.inner_first, n, list.n_crossing);
  reserve_pairs(list);
  Kokkos::parallel_for("neighbors: fill", n,
                       FillPairs{.search = pair_search,
                                 .noted = noted,
                                 .list = list,
                                 .kept = kept_,
                                 .old_row = row_,
                                 .id = grains.id,
                                 .has_kept = has_kept_});
  has_kept_ = false;
  register_others(list, n);
}

void NeighborList::rebuild(GrainState& grains, bool drop) {
  const Kokkos::Profiling::ScopedRegion region("list rebuild");
  check_positions(grains);
  take_room(grains);
  wrap(grains);
  if (rebuilds_ > 0) keep_contacts(grains);
  if (ranks_) redistribute(grains);
  sort(grains, drop);
  const auto kin = grains.kin;
  const auto reference = grains.x_reference;
  Kokkos::parallel_for(
      "neighbors: reference positions", grains.n,
      KOKKOS_LAMBDA(int g) { reference(g) = kin(g).x; });
  if (ranks_) find_ghosts(grains, grains.kin);
  search(grains, grains.kin);
  ++rebuilds_;
}

void NeighborList::find_ghosts(GrainState& grains, Kokkos::View<GrainKinematics*>& kin) {
  const GrainPartition& partition = ranks_->partition;
  ranks_->ghosts.find(grains, kin, columns_, partition.owners(), partition.ranks());
}

void NeighborList::update_ghosts(const GrainState& grains) const {
  if (ranks_) ranks_->ghosts.update(grains.kin);
}

void NeighborList::restore(GrainState& grains) {
  const int n = grains.n;
  take_room(grains);
  Kokkos::View<GrainKinematics*> at_reference("kinematics at the last rebuild",
                                              static_cast<std::size_t>(std::max(n, 1)));
  const auto kin = grains.kin, moved = at_reference;
  const auto reference = grains.x_reference;
  const auto row = row_;
  Kokkos::parallel_for(
      "neighbors: restore reference", n, KOKKOS_LAMBDA(int g) {
        moved(g) = kin(g);
        moved(g).x = reference(g);
        row(g) = g;
      });
  if (ranks_) {
    columns_.origin = ranks_->partition.origin();
    find_ghosts(grains, at_reference);
    reserve_rows(grains.kin, n + grains.n_ghosts);
    const std::pair<int, int> ghosts(n, n + grains.n_ghosts);
    Kokkos::deep_copy(Kokkos::subview(grains.kin, ghosts), Kokkos::subview(at_reference, ghosts));
    update_ghosts(grains);
  }
  search(grains, at_reference);
  ++rebuilds_;
}

}  // namespace barchan
