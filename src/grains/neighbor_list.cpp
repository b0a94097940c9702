#include "src/grains/neighbor_list.hpp"

#include <fmt/format.h>

#include <Kokkos_Profiling_ScopedRegion.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "src/base/errors.hpp"
#include "src/base/stopwatch.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/grains/list_memory.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"
#include "src/parallel/sort.hpp"

namespace barchan {

namespace {

int column_count(Real extent, Real cutoff, bool periodic, const char* axis) {
  const int n = std::clamp(static_cast<int>(std::floor(extent / cutoff)), 1, kMaxColumns);
  if (periodic && n < 3) {
    throw std::runtime_error(
        fmt::format("the domain is too narrow along {} for periodic grains: it must be at least "
                    "three contact ranges ({:f} m) wide",
                    axis, 3 * cutoff));
  }
  return n;
}

}  // namespace

NeighborList::NeighborList(const GrainsCase& config, Real r_max, MPI_Comm ranks, Real reach,
                           const LongestArm& longest_arm)
    : skins_(config, r_max, reach),
      lx_(config.size[0]),
      leaves_x_(grains_leave(config.grains)),
      half_strip_(config.half_edge_strip) {
  const Real lz = config.size[2];
  columns_.periodic_x = is_periodic_x(config.grains);
  columns_.periodic_z = config.grains.boundary_z == GrainBoundaryZ::periodic;
  const Real cutoff = skins_.column_width();
  columns_.half_reach = reach / 2;
  columns_.rings = skins_.rings();
  columns_.max_narrow = cutoff / 2;
  columns_.nx = column_count(lx_, cutoff, columns_.periodic_x, "x");
  columns_.nz = column_count(lz, cutoff, columns_.periodic_z, "z");
  columns_.inverse_width_x = columns_.nx / lx_;
  columns_.inverse_width_z = columns_.nz / lz;
  columns_.height = config.size[1];
  columns_.arms = rank_count(ranks) > 1 ? columns_of_arm(longest_arm, columns_) : 0;
  box_.lx = columns_.periodic_x ? lx_ : 0;
  box_.lz = columns_.periodic_z ? lz : 0;
  if (rank_count(ranks) > 1) ranks_ = std::make_unique<Ranks>(ranks);
}

void NeighborList::take_memory(const GrainState& grains) {
  scratch_.free_all();
  const int n = grains.n + grains.n_ghosts + static_cast<int>(new_.size());
  take_scratch(scratch_, entry_, "entry in the contact history", n + 1);
  take_scratch(scratch_, grain_memory_, "room of a rebuild", n);
  take_scratch(scratch_, key_memory_, "keys of a rebuild", 2 * n);
  take_scratch(scratch_, occupied_.of_grain, "column of grain", n);
}

/// Makes room for n entries: grains from other ranks, and ghosts, may need more than before.
void NeighborList::reserve_memory(int n) {
  reserve(grain_memory_, "room of a rebuild", n);
  reserve(key_memory_, "keys of a rebuild", 2 * n);
  reserve(occupied_.of_grain, "column of grain", n);
}

void NeighborList::wrap(const GrainState& grains) const {
  const auto kin = grains.kin;
  const auto clump = grains.clump;
  const PeriodicBox box = box_;
  int bad = grains.n;
  Kokkos::parallel_reduce(
      "neighbors: wrap positions", grains.n,
      KOKKOS_LAMBDA(int g, int& first) {
        Vec3& x = kin(g).x;
        x = box.wrap(x);
        if (clump.extent(0) > 0) clump(g).x = box.wrap(clump(g).x);
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
  throw StateError(fmt::format("the position of grain {} is not finite{}", grain_number(grains, id),
                               rebuilds_ > 0 ? place : ""),
                   ranks_ == nullptr);
}

/// Collects the contact history. New grains get entries in it, without contacts.
void NeighborList::collect_history(const GrainState& grains) {
  const PairList& list = grains.list;
  const int n = grains.n + static_cast<int>(new_.size());
  const GrainsWithHistory with_history{.list = list, .id = grains.id, .both = ranks_ != nullptr};
  take_scratch(scratch_, history_.first, "contact history: first", n + 1);
  Kokkos::deep_copy(history_.first, 0);
  Kokkos::parallel_for("neighbors: count contacts", list.n_pairs,
                       CountContacts{.grains = with_history, .count = history_.first});
  const auto take = [&, n_contacts = counts_to_offsets(history_.first, n)](auto& array) {
    take_scratch(scratch_, array, "contact history", n_contacts);
  };
  take(history_.partner), take(history_.xi_t);
  if (list.has_rolling()) take(history_.rolling);
  if (list.has_force()) take(history_.force);
  const std::pair<int, int> entries(0, n);
  Kokkos::deep_copy(Kokkos::subview(entry_, entries), Kokkos::subview(history_.first, entries));
  Kokkos::parallel_for(
      "neighbors: fill the contact history", list.n_pairs,
      FillContactHistory{.grains = with_history, .history = history_, .cursor = entry_});
  has_history_ = true;
}

/// Sends grains to the ranks that own their columns, after new cuts where the work asks for them.
void NeighborList::redistribute(GrainState& grains) {
  if (!has_history_) history_.first = Kokkos::View<int*>("contact history: first", grains.n + 1);
  ranks_->partition.balance(grains, columns_, history_.first);
  columns_.origin = ranks_->partition.origin();
  ranks_->migrate(grains, history_, columns_, ranks_->partition.owners(), grain_memory_);
}

void NeighborList::sort(GrainState& grains, bool drop) {
  const int n = grains.n;
  reserve(entry_, "entry in the contact history", n + 1);
  reserve_memory(n);
  const std::pair<int, int> entries(0, n);
  const auto key = Kokkos::subview(key_memory_, entries);
  const auto entry = Kokkos::subview(entry_, entries);
  const auto kin = grains.kin;
  const SearchColumns columns = columns_;
  const CountLeaving who = leaving(grains);
  const bool drops = drop && leaves_x_;
  int n_dropped = 0;
  Kokkos::parallel_reduce(
      "neighbors: sort keys", n,
      KOKKOS_LAMBDA(int g, int& dropped) {
        const bool outside = drops && who.leaves(g);
        key(g) = outside ? kDroppedKey : columns.key_of(kin(g).x);
        entry(g) = g;
        dropped += outside ? 1 : 0;
      },
      n_dropped);
  grains.n_left += grains.clump.size() > 0 && n_dropped > 0 ? clumps_in(grains, key) : n_dropped;
  sort_by_key(key, entry);
  permute(grains, entry, n - n_dropped, grain_memory_);
}

Windows NeighborList::find_windows(const Kokkos::View<GrainKinematics*>& grains, int n) {
  const NumberColumns find{.columns = columns_, .grains = grains, .occupied = occupied_};
  occupied_.n = scan("neighbors: occupied columns", Kokkos::RangePolicy<>(0, n), find);
  reserve(occupied_.id, "occupied columns", occupied_.n);
  reserve(occupied_.start, "column starts", occupied_.n + 1);
  Kokkos::parallel_for("neighbors: column starts", n,
                       StartColumns{.columns = columns_, .grains = grains, .occupied = occupied_});
  Kokkos::deep_copy(Kokkos::subview(occupied_.start, occupied_.n), n);
  reserve(occupied_.forward, "forward columns", occupied_.n);
  reserve(occupied_.widest, "widest of columns", occupied_.n);
  Kokkos::parallel_for("neighbors: link columns", occupied_.n,
                       LinkColumns{.columns = columns_, .grains = grains, .occupied = occupied_});
  static_assert(kForwardColumns * sizeof(int) == 2 * sizeof(std::uint64_t));
  const Windows window = used_as<Windows>(key_memory_, n);
  Kokkos::parallel_for("neighbors: windows", occupied_.n,
                       FindWindows{.grains = grains, .occupied = occupied_, .window = window});
  return window;
}

void NeighborList::reserve_pairs(PairList& list) const {
  reserve(list.i, "pairs: i", list.n_pairs);
  reserve(list.j, "pairs: j", list.n_pairs);
  reserve(list.incoming, "pairs: incoming slot", list.n_inter);
  reserve(list.pair_force, "pairs: force of an inter-chunk pair", list.n_inter);
  reserve(list.active, "pairs: active", list.n_pairs - list.n_inter + 1);
  reserve(list.n_active, "chunks: active pairs", list.chunks.count());
  reserve(list.slack, "pairs: slack", kOnHost ? list.chunks.n : 0);
  reserve(list.expired, "chunks: expired", list.chunks.count());
  Kokkos::deep_copy(list.expired, 1);
  reserve(list.xi_t, "pairs: xi_t", list.n_pairs);
  reserve(list.touching, "pairs: touching", list.n_pairs);
  if (with_laws) reserve(list.law, "pairs: law", list.n_pairs);
  if (with_rolling) reserve(list.rolling, "pairs: rolling", list.n_pairs);
  if (with_force) reserve(list.force, "pairs: force", list.n_pairs);
}

void NeighborList::rebuild(GrainState& grains, bool drop) {
  const Kokkos::Profiling::ScopedRegion region("list rebuild");
  const ScopedSeconds timer(seconds_);
  if (rebuilds_ == 0 && grains.clump.size() > 0) check_motions(grains);
  wrap(grains);
  take_memory(grains);
  if (rebuilds_ > 0) collect_history(grains);
  if (!new_.empty()) append_new(grains);
  if (ranks_) redistribute(grains);
  sort(grains, drop);
  skins_.set(grains);
  find_ghosts_and_pairs(grains);
  Kokkos::fence("end of a list rebuild: its kernels count as its own");
}

/// Ends a rebuild: finds ghosts and pairs; from here on the list holds.
void NeighborList::find_ghosts_and_pairs(GrainState& grains) {
  if (ranks_) ranks_->ghosts.find(grains, columns_, ranks_->partition.owners());
  if (grains.clump.size() > 0) find_members(grains, key_memory_);
  search(grains);
  ++rebuilds_;
}

void NeighborList::restore(GrainState& grains) {
  const int n = grains.n;
  if (!skins_.suit(grains)) return rebuild(grains, false);
  take_memory(grains);
  Kokkos::View<GrainKinematics*> at_reference("kinematics at the last rebuild",
                                              static_cast<std::size_t>(std::max(n, 1)));
  const auto kin = grains.kin, moved = at_reference;
  const auto reference = grains.x_reference;
  const auto entry = entry_;
  Kokkos::parallel_for(
      "neighbors: restore reference", n, KOKKOS_LAMBDA(int g) {
        moved(g) = kin(g);
        moved(g).x = reference(g);
        entry(g) = g;
      });
  if (ranks_) columns_.origin = ranks_->partition.origin();
  std::swap(grains.kin, at_reference);  // ghosts and pairs are those of that time
  find_ghosts_and_pairs(grains);
  std::swap(grains.kin, at_reference);
  if (!ranks_) return;
  reserve_entries(grains.kin, n + grains.n_ghosts);
  const std::pair<int, int> ghosts(n, n + grains.n_ghosts);
  Kokkos::deep_copy(Kokkos::subview(grains.kin, ghosts), Kokkos::subview(at_reference, ghosts));
  update_ghosts(grains);
}

}  // namespace barchan
