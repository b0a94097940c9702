#include "src/grains/grain_migration.hpp"

#include <algorithm>
#include <utility>

#include "src/grains/grain_arrays.hpp"
#include "src/grains/list_memory.hpp"

namespace barchan {

namespace {

using Entries = Kokkos::View<int*>;

/// Calls action(array) for each array of a contact history.
template <class History, class Action>
void for_each_contact_array(History& history, const Action& action) {
  const auto if_there = [&action](auto& array) {
    if (array.extent(0) > 0) action(array);
  };
  if_there(history.partner), if_there(history.xi_t);
  if_there(history.rolling), if_there(history.force);
}

PackLayout layout_of(const ContactHistory& history) {
  PackLayout layout;
  for_each_contact_array(history, [&](const auto& array) { layout.add(array); });
  return layout;
}

/// Rank that owns the column of each grain; -1 where this one does.
Entries new_ranks(const GrainState& grains, const SearchColumns& columns,
                  const GrainOwners& owners) {
  const auto rank = uninitialized<Entries>("migration: ranks of grains", grains.n);
  const PlaceOfGrain place{grains.kin, grains.clump};
  Kokkos::parallel_for(
      "migration: ranks of grains", items(grains.n), KOKKOS_LAMBDA(int g) {
        const int owner = owners.of_code(columns.morton_code_of(place(g)));
        rank(g) = owner == owners.me ? -1 : owner;
      });
  return rank;
}

/// Destination of each contact: that of its grain.
Entries ranks_of_contacts(const Entries& rank_of_grain, const Entries& first, int n,
                          int n_contacts) {
  const auto rank = uninitialized<Entries>("migration: ranks of contacts", n_contacts);
  Kokkos::parallel_for(
      "migration: ranks of contacts", items(n), KOKKOS_LAMBDA(int g) {
        for (int k = first(g); k < first(g + 1); ++k) rank(k) = rank_of_grain(g);
      });
  return rank;
}

/// Numbers of contacts of n grains, which travel with them, from the offsets.
using Numbers = Kokkos::View<std::int64_t*>;
Numbers contacts_of_grains(const Entries& first, int n) {
  const auto n_contacts = uninitialized<Numbers>("migration: contacts of grains", n);
  Kokkos::parallel_for(
      "migration: contacts of grains", items(n),
      KOKKOS_LAMBDA(int g) { n_contacts(g) = first(g + 1) - first(g); });
  return n_contacts;
}
Entries first_contacts(const Numbers& n_contacts, int n) {
  const auto first = uninitialized<Entries>("contact history: first", n + 1);
  Kokkos::parallel_for(
      "migration: contacts that are here", items(n),
      KOKKOS_LAMBDA(int g) { first(g) = static_cast<int>(n_contacts(g)); });
  counts_to_offsets(first, n);
  return first;
}

/// Keeps the entries `stay` of an array, and makes room for n.
template <class View>
void keep_entries(View& array, const Entries& stay, int n) {
  const View kept(array.label(), static_cast<std::size_t>(std::max(n, 1)));
  const View all = array;
  Kokkos::parallel_for(
      "migration: entries that stay", items(stay.extent_int(0)),
      KOKKOS_LAMBDA(int p) { kept(p) = all(stay(p)); });
  array = kept;
}

}  // namespace

void GrainMigration::operator()(GrainState& grains, ContactHistory& history,
                                const SearchColumns& columns, const GrainOwners& owners,
                                const Kokkos::View<Vec4*>& room) {
  const int n = grains.n, n_ranks = owners.start.extent_int(0);
  int n_contacts = 0;
  Kokkos::deep_copy(n_contacts, Kokkos::subview(history.first, n));
  const Entries rank = new_ranks(grains, columns, owners);
  const SendList entries = sort_by_rank(rank, n, n_ranks);
  const SendList contacts =
      sort_by_rank(ranks_of_contacts(rank, history.first, n, n_contacts), n_contacts, n_ranks);
  const ExchangeCounts entry_counts = exchange_counts(grains.ranks, entries.to);
  const ExchangeCounts contact_counts = exchange_counts(grains.ranks, contacts.to);
  const int n_to = entry_counts.n_to(), n_from = entry_counts.n_from();
  if (n_to == 0 && n_from == 0) return;
  n_sent_ += n_to;
  Numbers of_grains = contacts_of_grains(history.first, n);
  const auto whole_grain = [&] {
    PackLayout layout = layout_of(grains);
    layout.add(of_grains);
    return layout;
  };
  exchange_.exchange(entry_counts, whole_grain(), entries.entry);
  exchange_contacts_.exchange(contact_counts, layout_of(history), contacts.entry);

  const Entries stay = Kokkos::subview(entries.entry, std::pair<int, int>(n_to, n));
  permute(grains, stay, n - n_to, room);
  grains.n = n - n_to + n_from;
  reserve_entries(grains, grains.n);
  keep_entries(of_grains, stay, grains.n);
  exchange_.unpack(whole_grain(), {}, n - n_to);

  const int n_contacts_to = contact_counts.n_to(), n_contacts_stay = n_contacts - n_contacts_to;
  const Entries contacts_stay =
      Kokkos::subview(contacts.entry, std::pair<int, int>(n_contacts_to, n_contacts));
  for_each_contact_array(history, [&](auto& array) {
    keep_entries(array, contacts_stay, n_contacts_stay + contact_counts.n_from());
  });
  exchange_contacts_.unpack(layout_of(history), {}, n_contacts_stay);
  history.first = first_contacts(of_grains, grains.n);
}

}  // namespace barchan
