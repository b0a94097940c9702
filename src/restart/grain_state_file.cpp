#include "src/restart/grain_state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/base/words.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"
#include "src/restart/feed_state_file.hpp"

namespace barchan {

namespace {

/// The first n entries of an array of a grain.
template <class View>
auto first_entries(const View& v, int n) {
  const std::pair<int, int> entries(0, n);
  if constexpr (View::rank() == 2) return Kokkos::subview(v, entries, Kokkos::ALL());
  if constexpr (View::rank() == 1) return Kokkos::subview(v, entries);
}

/// Calls f(name, array) for every array of a grain that the next step reads.
template <class F>
void for_each_saved_array(const GrainState& s, const F& f) {
  const bool with_flow = s.exchange.pressure_force.extent(0) > 0;
  for_each_grain_array(s, with_flow ? kRestart | kRestartWithFlow : kRestart,
                       [&](const GrainArray& about, const auto& array) {
                         f("grains/" + std::string(about.name), array);
                       });
}

/// Entries of this rank among those of all ranks. In the file the last index of a view, which is
/// not always the entries, runs slowest, but for components.
template <class View>
void save_entries(CheckpointWriter& file, const std::string& name, const View& mine,
                  const Hyperslab& entries) {
  const auto numbers = checkpoint_detail::to_numbers(mine);
  const Extents extents = checkpoint_detail::file_extents(mine);
  file.array(name, std::span(numbers), extents, slab_of(entries, extents, View::rank() - 1));
}

/// Entries [begin, begin + entries of the view) of n_all.
template <class View>
void load_entries(const CheckpointReader& file, const std::string& name, const View& mine,
                  std::uint64_t begin, std::uint64_t n_all) {
  using Number = typename checkpoint_detail::Stored<typename View::non_const_value_type>::type;
  const Extents extents = checkpoint_detail::file_extents(mine);
  Extents whole = extents, first(extents.size(), 0);
  whole[View::rank() - 1] = n_all;
  first[View::rank() - 1] = begin;
  checkpoint_detail::from_numbers(file.array<Number>(name, whole, first, extents), mine);
}

template <class T>
using HostEntries = Kokkos::View<T*, Kokkos::HostSpace>;

/// Contacts [begin, end) of the file under the entries of this rank's grains; `both`: under both of
/// their grains.
ContactHistory load_contacts(const CheckpointReader& file, const GrainState& s, std::uint64_t begin,
                             std::uint64_t end, bool both, bool with_rolling) {
  constexpr std::uint64_t piece = 1 << 20;
  const auto id = host_copy(s.id);
  std::unordered_map<std::int64_t, int> entry;
  for (int g = 0; g < s.n; ++g) entry[id(g)] = g;
  struct Contact {
    int entry;
    std::int64_t partner;
    Vec3 xi_t, rolling;
  };
  std::vector<Contact> contacts;
  const std::uint64_t n_all = file.extents("contacts/first")[0];
  for (; begin < end; begin += piece) {
    const std::uint64_t n = std::min(end - begin, piece);
    const HostEntries<std::int64_t> first("host: first", n), second("host: second", n);
    const HostEntries<Vec3> xi_t("host: xi_t", n), rolling("host: rolling", n);
    load_entries(file, "contacts/first", first, begin, n_all);
    load_entries(file, "contacts/second", second, begin, n_all);
    load_entries(file, "contacts/xi_t", xi_t, begin, n_all);
    if (with_rolling) load_entries(file, "contacts/rolling", rolling, begin, n_all);
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto a = entry.find(first(k)), b = entry.find(second(k));
      if (a != entry.end()) contacts.push_back({a->second, second(k), xi_t(k), rolling(k)});
      if (b != entry.end() && (both || a == entry.end()))
        contacts.push_back({b->second, first(k), -xi_t(k), -rolling(k)});
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return a.entry < b.entry; });
  std::vector<int> first(static_cast<std::size_t>(s.n) + 1, 0);
  std::vector<std::int64_t> partner;
  std::vector<Vec3> xi_t, rolling;
  for (const Contact& contact : contacts) {
    ++first[static_cast<std::size_t>(contact.entry) + 1];
    partner.push_back(contact.partner);
    xi_t.push_back(contact.xi_t);
    rolling.push_back(contact.rolling);
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return {.first = to_device("contact history: first", first, 1),
          .partner = to_device("contact history: partner", partner, 1),
          .xi_t = to_device("contact history: xi_t", xi_t, 1),
          .rolling = with_rolling ? to_device("contact history: rolling", rolling, 1)
                                  : Kokkos::View<Vec3*>(),
          .force = {}};
}

/// [begin, end) of this rank in an array of n entries whose shares were written by as many ranks,
/// or nothing.
struct Piece {
  std::uint64_t begin = 0, end = 0;
};
std::optional<Piece> my_piece(const CheckpointReader& file, const std::string& name,
                              std::uint64_t n, MPI_Comm ranks) {
  const auto counts = file.array<std::int64_t>(name);
  std::vector<std::uint64_t> offsets{0};
  bool fits = true;
  for (const std::int64_t count : counts) {
    offsets.push_back(offsets.back() + static_cast<std::uint64_t>(count));
    fits = fits && count >= 0 && offsets.back() <= n;
  }
  if (!fits || offsets.back() != n) file.fail(name + " does not fit the entries it counts");
  if (counts.size() != static_cast<std::size_t>(rank_count(ranks))) return {};
  const auto me = static_cast<std::size_t>(rank_of(ranks));
  return Piece{offsets[me], offsets[me + 1]};
}

std::uint64_t entries_of(const CheckpointReader& file, const std::string& name) {
  const Extents extents = file.extents(name);
  if (extents.empty()) file.fail(name + " is not an array");
  return extents[0];
}

Piece my_entries(const CheckpointReader& file, MPI_Comm ranks) {
  const std::uint64_t n = entries_of(file, "grains/id");
  if (n > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    file.fail(fmt::format("it holds {} grains, more than this version can count", n));
  if (const auto piece = my_piece(file, "grains/of_rank", n, ranks)) return *piece;
  const BlockPartition split{.n = static_cast<int>(n), .parts = rank_count(ranks)};
  const auto begin = [&](int rank) { return static_cast<std::uint64_t>(split.begin(rank)); };
  return {begin(rank_of(ranks)), begin(rank_of(ranks) + 1)};
}

void save_of_every_rank(CheckpointWriter& file, const std::string& name, MPI_Comm ranks,
                        std::int64_t mine) {
  file.array(name, std::span<const std::int64_t>(&mine, 1), {1}, slab_of_entries(1, ranks));
}

/// Writes all contacts of this rank's list, by the ids of both grains: one of owned and ghost grain
/// is on both ranks.
void save_contacts(CheckpointWriter& file, const GrainState& s) {
  const PairList& list = s.list;
  const auto here = [](const auto& view, int n) { return host_copy(first_entries(view, n)); };
  const auto touching = here(list.touching, list.n_pairs);
  const auto i = here(list.i, list.n_pairs), j = here(list.j, list.n_pairs);
  const auto xi_t = here(list.xi_t, list.n_pairs);
  const auto rolling = here(list.rolling, list.has_rolling() ? list.n_pairs : 0);
  const auto id = here(s.id, s.n + s.n_ghosts);
  std::vector<int> pairs;
  for (int p = 0; p < list.n_pairs; ++p) {
    if (touching(p)) pairs.push_back(p);
  }
  const Hyperslab entries = slab_of_entries(pairs.size(), s.ranks);
  const auto save = [&](const std::string& name, const auto& value_of) {
    const HostEntries<decltype(value_of(0))> values("host: " + name, pairs.size());
    std::transform(pairs.begin(), pairs.end(), values.data(), value_of);
    save_entries(file, name, values, entries);
  };
  save("contacts/first", [&](int p) { return id(i(p)); });
  save("contacts/second", [&](int p) { return id(j(p)); });
  save("contacts/xi_t", [&](int p) { return xi_t(p); });
  if (list.has_rolling()) save("contacts/rolling", [&](int p) { return rolling(p); });
  save_of_every_rank(file, "contacts/of_rank", s.ranks, static_cast<std::int64_t>(pairs.size()));
}

/// Last id given to a grain. In a file of an earlier version at least that of the grains in it:
/// others may have left.
std::int64_t last_id_in(const CheckpointReader& file, const GrainState& s) {
  if (file.has("grains/last_id")) return file.integer("grains/last_id");
  std::int64_t last = s.n_initial;
  const auto id = host_copy(s.id);
  for (int g = 0; g < s.n; ++g) last = std::max(last, id(g));
  all_reduce(s.ranks, std::span(&last, 1), MPI_MAX);
  return last;
}

}  // namespace

void save_grains(CheckpointWriter& file, const GrainState& s, const NeighborList& list) {
  const Hyperslab entries = slab_of_entries(static_cast<std::uint64_t>(s.n), s.ranks);
  for_each_saved_array(s, [&](const std::string& name, const auto& array) {
    save_entries(file, name, first_entries(array, s.n), entries);
  });
  if (s.heap.size() > 0) file.scalar("grains/heap_names", as_lines(s.heap_names));
  save_contacts(file, s);
  save_of_every_rank(file, "grains/of_rank", s.ranks, s.n);
  if (const GrainPartition* partition = list.partition()) {
    const auto offsets = partition->offsets();
    file.array("grains/columns_of_rank", std::span<const std::int64_t>(offsets));
    file.scalar("grains/imbalance_at_cut", partition->imbalance_at_cut());
  }
  file.scalar("grains/r_max", s.r_max);
  file.scalar("grains/r_min", s.r_min);
  file.scalar("grains/sauter_diameter", s.sauter_diameter);
  file.scalar("grains/n_initial", s.n_initial);
  file.scalar("grains/last_id", last_id(s));
  file.scalar("grains/n_left", sum_over(s.ranks, s.n_left));
  save_feed(file, s.feed);
  if (std::isfinite(s.window_edge)) file.scalar("grains/seam_x", s.window_edge);
}

GrainState grains_in_file(const CheckpointReader& file, MPI_Comm ranks) {
  const Piece entries = my_entries(file, ranks);
  GrainState s = make_grain_entries(static_cast<int>(entries.end - entries.begin), ranks);
  if (file.has("grains/heap")) add_heaps(s, lines_of(file.text("grains/heap_names")));
  s.r_max = file.real("grains/r_max");
  s.r_min = file.real("grains/r_min");
  s.sauter_diameter = file.real("grains/sauter_diameter");
  s.n_initial = file.integer("grains/n_initial");
  s.n_left = rank_of(ranks) == 0 ? file.integer("grains/n_left") : 0;
  s.feed = load_feed(file);
  if (file.has("grains/seam_x")) s.window_edge = file.real("grains/seam_x");
  if (!(s.r_min > 0 && s.r_min <= s.r_max && std::isfinite(s.r_max) && s.sauter_diameter > 0))
    file.fail("the radii of its grains make no sense");
  return s;
}

void load_grains(const CheckpointReader& file, GrainState& s, NeighborList& list) {
  const Piece entries = my_entries(file, s.ranks);
  const std::uint64_t n_all = entries_of(file, "grains/id");
  for_each_saved_array(s, [&](const std::string& name, const auto& array) {
    load_entries(file, name, first_entries(array, s.n), entries.begin, n_all);
  });
  s.last_id = last_id_in(file, s);
  const bool rolls = list.with_rolling, both = rank_count(s.ranks) > 1;
  const std::uint64_t n_contacts = entries_of(file, "contacts/first");
  const auto piece = my_piece(file, "contacts/of_rank", n_contacts, s.ranks);
  const Piece contacts = piece.value_or(Piece{0, n_contacts});
  list.set_history(load_contacts(file, s, contacts.begin, contacts.end, both, rolls));
  if (!piece) {
    list.rebuild(s, false);
    return;
  }
  if (list.partition()) {
    const auto offsets = file.array<std::int64_t>(
        "grains/columns_of_rank", {static_cast<std::uint64_t>(rank_count(s.ranks))});
    if (offsets.front() != 0 || !std::is_sorted(offsets.begin(), offsets.end()) ||
        offsets.back() > std::numeric_limits<std::uint32_t>::max())
      file.fail("grains/columns_of_rank does not cut the columns");
    list.partition()->restore(offsets, file.real("grains/imbalance_at_cut"));
  }
  list.restore(s);
}

}  // namespace barchan
