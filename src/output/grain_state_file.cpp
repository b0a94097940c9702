#include "src/output/grain_state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/base/errors.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/io/row_share.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// The first n rows of an array of a grain.
template <class View>
auto first_rows(const View& v, int n) {
  const std::pair<int, int> rows(0, n);
  if constexpr (View::rank() == 2) return Kokkos::subview(v, rows, Kokkos::ALL());
  if constexpr (View::rank() == 1) return Kokkos::subview(v, rows);
}

/// Calls f(name, array) for every array of a grain that the next step reads.
template <class F>
void for_each_saved_array(const GrainState& s, const F& f) {
  const bool with_flow = s.exchange.fluid_force.extent(0) > 0;
  for_each_grain_array(s, with_flow ? kRestart | kRestartWithFlow : kRestart,
                       [&](const GrainArray& about, const auto& array) {
                         f("grains/" + std::string(about.name), array);
                       });
}

/// Contacts as a file has them: ids of both grains, and what the first one remembers.
struct ContactTable {
  std::vector<std::int64_t> first, second;
  std::vector<double> xi_t, rolling;  // three numbers each; rolling may be empty
  std::size_t size() const { return first.size(); }
};

/// All contacts of this rank's list: one of owned and ghost grain is on both ranks.
ContactTable contact_table(const GrainState& s) {
  const PairList& list = s.list;
  const auto here = [](const auto& view, int n) {
    return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{},
                                               Kokkos::subview(view, std::pair<int, int>(0, n)));
  };
  const auto touching = here(list.touching, list.n_pairs);
  const auto i = here(list.i, list.n_pairs), j = here(list.j, list.n_pairs);
  const auto xi_t = here(list.xi_t, list.n_pairs);
  const auto rolling = here(list.rolling, list.has_rolling() ? list.n_pairs : 0);
  const auto id = here(s.id, s.n + s.n_ghosts);
  ContactTable table;
  const auto add = [](std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x, v.y, v.z});
  };
  for (int p = 0; p < list.n_pairs; ++p) {
    if (!touching(p)) continue;
    table.first.push_back(id(i(p)));
    table.second.push_back(id(j(p)));
    add(table.xi_t, xi_t(p));
    if (list.has_rolling()) add(table.rolling, rolling(p));
  }
  return table;
}

template <class View, class T>
View to_device(const char* label, const std::vector<T>& numbers) {
  using Value = typename View::non_const_value_type;
  const View view(label, std::max<std::size_t>(numbers.size() * sizeof(T) / sizeof(Value), 1));
  const auto host = Kokkos::create_mirror_view(view);
  std::copy(numbers.begin(), numbers.end(), reinterpret_cast<T*>(host.data()));
  Kokkos::deep_copy(view, host);
  return view;
}

/// Contacts under the rows of this rank's grains; `both`: under both of their grains.
ContactHistory under_rows(const ContactTable& table, const GrainState& s, bool both,
                          bool with_rolling) {
  const auto id = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, s.id);
  std::unordered_map<std::int64_t, int> row;
  for (int g = 0; g < s.n; ++g) row[id(g)] = g;
  struct Place {
    int row;
    std::size_t contact;
    bool turned;  // seen from the second grain
  };
  std::vector<Place> places;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto a = row.find(table.first[k]), b = row.find(table.second[k]);
    if (a != row.end()) places.push_back({a->second, k, false});
    if (b != row.end() && (both || a == row.end())) places.push_back({b->second, k, true});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.row < b.row; });
  std::vector<int> first(static_cast<std::size_t>(s.n) + 1, 0);
  std::vector<std::int64_t> partner;
  std::vector<double> xi_t, rolling;
  for (const Place& p : places) {
    ++first[static_cast<std::size_t>(p.row) + 1];
    partner.push_back((p.turned ? table.first : table.second)[p.contact]);
    for (std::size_t q = 3 * p.contact; q < 3 * p.contact + 3; ++q) {
      const double sign = p.turned ? -1 : 1;
      xi_t.push_back(sign * table.xi_t[q]);
      if (!table.rolling.empty()) rolling.push_back(sign * table.rolling[q]);
    }
  }
  for (std::size_t g = 1; g < first.size(); ++g) first[g] += first[g - 1];
  return {.first = to_device<Kokkos::View<int*>>("contact history: first", first),
          .partner = to_device<Kokkos::View<std::int64_t*>>("contact history: partner", partner),
          .xi_t = to_device<Kokkos::View<Vec3*>>("contact history: xi_t", xi_t),
          .rolling = with_rolling
                         ? to_device<Kokkos::View<Vec3*>>("contact history: rolling", rolling)
                         : Kokkos::View<Vec3*>(),
          .force = {}};
}

/// Reads contacts [begin, end).
ContactTable read_contacts(const CheckpointReader& file, std::uint64_t begin, std::uint64_t end,
                           bool with_rolling) {
  const std::uint64_t all = file.extents("contacts/first")[0], n = end - begin;
  ContactTable table;
  table.first = file.part<std::int64_t>("contacts/first", {all}, {begin}, {n});
  table.second = file.part<std::int64_t>("contacts/second", {all}, {begin}, {n});
  table.xi_t = file.part<double>("contacts/xi_t", {all, 3}, {begin, 0}, {n, 3});
  if (with_rolling)
    table.rolling = file.part<double>("contacts/rolling", {all, 3}, {begin, 0}, {n, 3});
  return table;
}

/// Those of all contacts that are of this rank's grains, read in pieces.
ContactTable contacts_of(const CheckpointReader& file, const GrainState& s, bool with_rolling) {
  constexpr std::uint64_t piece = 1 << 20;
  const auto id = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, s.id);
  std::vector<std::int64_t> mine(id.data(), id.data() + s.n);
  std::sort(mine.begin(), mine.end());
  const auto is_mine = [&](std::int64_t g) {
    return std::binary_search(mine.begin(), mine.end(), g);
  };
  ContactTable all;
  const std::uint64_t n = file.extents("contacts/first")[0];
  for (std::uint64_t begin = 0; begin < n; begin += piece) {
    const ContactTable some = read_contacts(file, begin, std::min(n, begin + piece), with_rolling);
    for (std::size_t k = 0; k < some.size(); ++k) {
      if (!is_mine(some.first[k]) && !is_mine(some.second[k])) continue;
      all.first.push_back(some.first[k]);
      all.second.push_back(some.second[k]);
      for (std::size_t q = 3 * k; q < 3 * k + 3; ++q) {
        all.xi_t.push_back(some.xi_t[q]);
        if (!some.rolling.empty()) all.rolling.push_back(some.rolling[q]);
      }
    }
  }
  return all;
}

[[noreturn]] void refuse(const CheckpointReader& file, const std::string& what) {
  throw InputError(fmt::format("cannot restart from {}: {}", file.path().string(), what));
}

/// [begin, end) of this rank in an array of n rows whose shares were written by as many ranks, or
/// nothing.
struct Piece {
  std::uint64_t begin = 0, end = 0;
};
std::optional<Piece> my_piece(const CheckpointReader& file, const std::string& name,
                              std::uint64_t n, MPI_Comm ranks) {
  const auto counts = file.array<std::int64_t>(name);
  std::vector<std::uint64_t> starts{0};
  bool fits = true;
  for (const std::int64_t count : counts) {
    starts.push_back(starts.back() + static_cast<std::uint64_t>(count));
    fits = fits && count >= 0 && starts.back() <= n;
  }
  if (!fits || starts.back() != n) refuse(file, name + " does not fit the rows it counts");
  if (counts.size() != static_cast<std::size_t>(rank_count(ranks))) return {};
  const auto me = static_cast<std::size_t>(rank_of(ranks));
  return Piece{starts[me], starts[me + 1]};
}

std::uint64_t rows_of(const CheckpointReader& file, const std::string& name) {
  const Extents extents = file.extents(name);
  if (extents.empty()) refuse(file, name + " is not an array");
  return extents[0];
}

Piece my_rows(const CheckpointReader& file, MPI_Comm ranks) {
  const std::uint64_t n = rows_of(file, "grains/id");
  if (n > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    refuse(file, fmt::format("it holds {} grains, more than this version can count", n));
  if (const auto piece = my_piece(file, "grains/of_rank", n, ranks)) return *piece;
  const Split split{.n = static_cast<int>(n), .parts = rank_count(ranks)};
  const auto begin = [&](int rank) { return static_cast<std::uint64_t>(split.begin(rank)); };
  return {begin(rank_of(ranks)), begin(rank_of(ranks) + 1)};
}

void save_of_every_rank(CheckpointWriter& file, const std::string& name, MPI_Comm ranks,
                        std::int64_t mine) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(rank_count(ranks)));
  all[static_cast<std::size_t>(rank_of(ranks))] = mine;
  sum_over(ranks, all);
  file.array(name, std::span<const std::int64_t>(all));
}

void save_contacts(CheckpointWriter& file, const GrainState& s) {
  const ContactTable table = contact_table(s);
  const Share rows = share_of_rows(table.size(), s.ranks);
  const auto save = [&](const char* name, const auto& numbers, const Extents& extents) {
    file.array(name, std::span(numbers), extents, share_of(rows, extents, 0));
  };
  save("contacts/first", table.first, {table.size()});
  save("contacts/second", table.second, {table.size()});
  save("contacts/xi_t", table.xi_t, {table.size(), 3});
  if (s.list.has_rolling()) save("contacts/rolling", table.rolling, {table.size(), 3});
  save_of_every_rank(file, "contacts/of_rank", s.ranks, static_cast<std::int64_t>(table.size()));
}

}  // namespace

void save_grains(CheckpointWriter& file, const GrainState& s, const NeighborList& list) {
  const Share rows = share_of_rows(static_cast<std::uint64_t>(s.n), s.ranks);
  for_each_saved_array(s, [&](const std::string& name, const auto& array) {
    const auto mine = first_rows(array, s.n);
    const auto numbers = checkpoint_detail::to_numbers(mine);
    const Extents extents = checkpoint_detail::file_extents(mine);
    // In the file the first index, the rows, runs fastest but for components.
    file.array(name, std::span(numbers), extents, share_of(rows, extents, mine.rank() - 1));
  });
  save_contacts(file, s);
  save_of_every_rank(file, "grains/of_rank", s.ranks, s.n);
  if (const GrainPartition* partition = list.partition()) {
    const auto starts = partition->starts();
    file.array("grains/columns_of_rank", std::span<const std::int64_t>(starts));
    file.scalar("grains/imbalance_at_cut", partition->imbalance_at_cut());
  }
  file.scalar("grains/r_max", s.r_max);
  file.scalar("grains/r_min", s.r_min);
  file.scalar("grains/sauter_diameter", s.sauter_diameter);
  file.scalar("grains/n_initial", s.n_initial);
  file.scalar("grains/n_left", sum_over(s.ranks, s.n_left));
}

GrainState grains_in_file(const CheckpointReader& file, MPI_Comm ranks) {
  const Piece rows = my_rows(file, ranks);
  GrainState s = make_grain_rows(static_cast<int>(rows.end - rows.begin), ranks);
  s.r_max = file.real("grains/r_max");
  s.r_min = file.real("grains/r_min");
  s.sauter_diameter = file.real("grains/sauter_diameter");
  s.n_initial = file.integer("grains/n_initial");
  s.n_left = rank_of(ranks) == 0 ? file.integer("grains/n_left") : 0;
  if (!(s.r_min > 0 && s.r_min <= s.r_max && std::isfinite(s.r_max) && s.sauter_diameter > 0))
    refuse(file, "the radii of its grains make no sense");
  return s;
}

void load_grains(const CheckpointReader& file, GrainState& s, NeighborList& list) {
  const Piece rows = my_rows(file, s.ranks);
  const std::uint64_t n_all = rows_of(file, "grains/id");
  for_each_saved_array(s, [&](const std::string& name, const auto& array) {
    const auto mine = first_rows(array, s.n);
    using View = decltype(mine);
    using Number = typename checkpoint_detail::Stored<typename View::non_const_value_type>::type;
    const Extents extents = checkpoint_detail::file_extents(mine);
    Extents whole = extents, first(extents.size(), 0);
    whole[View::rank() - 1] = n_all;
    first[View::rank() - 1] = rows.begin;
    checkpoint_detail::from_numbers(file.part<Number>(name, whole, first, extents), mine);
  });
  const bool rolls = list.with_rolling, both = rank_count(s.ranks) > 1;
  const auto piece = my_piece(file, "contacts/of_rank", rows_of(file, "contacts/first"), s.ranks);
  const ContactTable contacts =
      piece ? read_contacts(file, piece->begin, piece->end, rolls) : contacts_of(file, s, rolls);
  list.set_history(under_rows(contacts, s, both, rolls));
  if (!piece) {
    list.rebuild(s, false);
    return;
  }
  if (list.partition()) {
    const auto starts = file.array<std::int64_t>("grains/columns_of_rank",
                                                 {static_cast<std::uint64_t>(rank_count(s.ranks))});
    if (starts.front() != 0 || !std::is_sorted(starts.begin(), starts.end()) ||
        starts.back() > std::numeric_limits<std::uint32_t>::max())
      refuse(file, "grains/columns_of_rank does not cut the columns");
    list.partition()->restore(starts, file.real("grains/imbalance_at_cut"));
  }
  list.restore(s);
}

}  // namespace barchan
