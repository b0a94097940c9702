#include "src/grains/neighbor_list.hpp"

#include <Kokkos_Profiling_ScopedRegion.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "src/grains/grain_arrays.hpp"
#include "src/grains/list_memory.hpp"
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

}  // namespace

NeighborList::NeighborList(const Config& config, Real r_max, MPI_Comm ranks)
    : skin_(config.grains->skin),
      r_max_(r_max),
      lx_(config.size[0]),
      exit_x_(config.grains->boundary_x == GrainBoundaryX::exit) {
  const Real cutoff = 2 * r_max + skin_;
  const Real lz = config.size[2];
  columns_.periodic_x = config.grains->boundary_x == GrainBoundaryX::periodic;
  columns_.periodic_z = config.grains->boundary_z == GrainBoundaryZ::periodic;
  columns_.nx = column_count(lx_, cutoff, columns_.periodic_x, "x");
  columns_.nz = column_count(lz, cutoff, columns_.periodic_z, "z");
  columns_.inverse_width_x = columns_.nx / lx_;
  columns_.inverse_width_z = columns_.nz / lz;
  columns_.height = config.size[1];
  box_.lx = columns_.periodic_x ? lx_ : 0;
  box_.lz = columns_.periodic_z ? lz : 0;
  if (rank_count(ranks) > 1) ranks_ = std::make_unique<Ranks>(ranks);
}

void NeighborList::take_room(const GrainState& grains) {
  idle_.free_all();
  const int n = grains.n + grains.n_ghosts;
  take_scratch(idle_, row_, "row in the contact history", n + 1);
  take_scratch(idle_, room_, "room of a rebuild", n);
  take_scratch(idle_, key_room_, "keys of a rebuild", 2 * n);
  take_scratch(idle_, occupied_.of_grain, "column of grain", n);
}

/// Those that came from other ranks, and ghosts, may need more.
void NeighborList::reserve_room(int n) {
  reserve(room_, "room of a rebuild", n);
  reserve(key_room_, "keys of a rebuild", 2 * n);
  reserve(occupied_.of_grain, "column of grain", n);
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
                                 .history = history_,
                                 .old_row = row_,
                                 .id = grains.id,
                                 .has_history = has_history_});
  has_history_ = false;
  register_others(list, n);
}

void NeighborList::rebuild(GrainState& grains, bool drop) {
  const Kokkos::Profiling::ScopedRegion region("list rebuild");
  check_positions(grains);
  take_room(grains);
  wrap(grains);
  if (rebuilds_ > 0) collect_history(grains);
  if (ranks_) redistribute(grains);
  sort(grains, drop);
  const auto kin = grains.kin;
  const auto reference = grains.x_reference;
  Kokkos::parallel_for(
      "neighbors: reference positions", grains.n,
      KOKKOS_LAMBDA(int g) { reference(g) = kin(g).x; });
  if (ranks_) find_ghosts(grains);
  search(grains, grains.kin);
  ++rebuilds_;
}

void NeighborList::find_ghosts(GrainState& grains) {
  const GrainPartition& partition = ranks_->partition;
  ranks_->ghosts.find(grains, columns_, partition.owners(), partition.ranks());
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
    std::swap(grains.kin, at_reference);  // ghosts are found where they were then
    find_ghosts(grains);
    std::swap(grains.kin, at_reference);
    reserve_rows(grains.kin, n + grains.n_ghosts);
    const std::pair<int, int> ghosts(n, n + grains.n_ghosts);
    Kokkos::deep_copy(Kokkos::subview(grains.kin, ghosts), Kokkos::subview(at_reference, ghosts));
    update_ghosts(grains);
  }
  search(grains, at_reference);
  ++rebuilds_;
}

}  // namespace barchan
