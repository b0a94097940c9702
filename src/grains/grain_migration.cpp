#include "src/grains/grain_migration.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

using Rows = Kokkos::View<int*>;

Rows make_rows(const char* label, int n) { return Rows(label, static_cast<std::size_t>(n)); }

Rows to_device(const char* label, const std::vector<int>& values) {
  const Rows rows = make_rows(label, static_cast<int>(values.size()));
  const auto host = Kokkos::create_mirror_view(rows);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(rows, host);
  return rows;
}

/// What is kept of a contact.
PackLayout layout_of(const ContactHistory& history) {
  PackLayout layout;
  const auto add = [&layout](const auto& array) {
    if (array.extent(0) > 0) layout.add(array);
  };
  add(history.partner), add(history.xi_t), add(history.rolling), add(history.force);
  return layout;
}

template <class View>
View of_size(const char* label, const View& like, int n) {
  return like.extent(0) > 0 ? View(label, static_cast<std::size_t>(std::max(n, 1))) : View();
}

}  // namespace

/// Fills row_, leaving_ and the numbers of grains to each rank.
void GrainMigration::choose(const GrainState& grains, const SearchColumns& columns,
                            const GrainOwners& owners) {
  const int n = grains.n;
  const Rows stay = make_rows("migration: rows that stay", n);
  const Rows leave = make_rows("migration: rows that leave", n);
  const Rows owner = make_rows("migration: owners of those", n);
  const auto kin = grains.kin;
  n_stay_ = 0;
  Kokkos::parallel_scan(
      "migration: who stays", items(n),
      KOKKOS_LAMBDA(int g, int& sum, bool final) {
        const int to = owners.of_place(columns.place_of(kin(g).x));
        const bool stays = to == owners.me;
        if (final) {
          (stays ? stay(sum) : leave(g - sum)) = g;
          if (!stays) owner(g - sum) = to;
        }
        sum += stays ? 1 : 0;
      },
      n_stay_);
  const std::pair<int, int> leavers(0, n - n_stay_);
  auto sorted = sort_by_rank(Kokkos::subview(owner, leavers), Kokkos::subview(leave, leavers),
                             owners.start.extent_int(0));
  row_ = stay;
  leaving_ = sorted.row;
  grains_.to = std::move(sorted.to);
  n_sent_ += n - n_stay_;
}

/// Tells the ranks how many grains and contacts they will get.
void GrainMigration::count(const GrainState& grains, const ContactHistory& history,
                           const GrainOwners& owners) {
  const int n = static_cast<int>(leaving_.extent(0));
  const Rows contacts = make_rows("migration: contacts", n);
  n_contacts_ = Kokkos::View<Real*>(
      Kokkos::view_alloc("migration: contacts of a grain", Kokkos::WithoutInitializing),
      static_cast<std::size_t>(n > 0 ? grains.n : 0));
  const auto row = leaving_;
  const auto first = history.first;
  const auto of_grain = n_contacts_;
  Kokkos::parallel_for(
      "migration: count contacts", items(n), KOKKOS_LAMBDA(int p) {
        contacts(p) = first(row(p) + 1) - first(row(p));
        of_grain(row(p)) = contacts(p);
      });
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, contacts);
  std::vector<int> starts, to;
  int p = 0, total = 0;
  for (std::size_t rank = 0; rank < owners.start.extent(0); ++rank) {
    const int before = total;
    for (const int end = p + grains_.to[rank]; p < end; ++p) {
      starts.push_back(total);
      total += host(p);
    }
    to.push_back(total - before);
  }
  first_ = to_device("migration: first contact", starts);
  grains_ = exchange_counts(grains.ranks, std::move(grains_.to));
  contacts_ = exchange_counts(grains.ranks, std::move(to));
}

void GrainMigration::send_contacts(const ContactHistory& history) {
  const Rows contact = make_rows("migration: contacts that leave", contacts_.n_to());
  const auto row = leaving_, first = first_;
  Kokkos::parallel_for(
      "migration: contacts that leave", items(grains_.n_to()), KOKKOS_LAMBDA(int p) {
        int at = first(p);
        for (int k = history.first(row(p)); k < history.first(row(p) + 1); ++k) contact(at++) = k;
      });
  exchange_contacts_.exchange(contacts_, layout_of(history), contact);
}

/// New contacts: of the rows that stayed, then what was received.
void GrainMigration::receive_contacts(ContactHistory& history) const {
  const int n_stay = n_stay_, n = n_stay + grains_.n_from();
  // Zero at first; then each row writes the start of the next one alone. If it wrote its own as
  // well, two threads would write the one between them.
  const Rows first = make_rows("contact history: first", n + 1);
  const ContactHistory old = history;
  const Rows row = row_;
  const Real* const received = exchange_.received();
  const int width = exchange_.width();  // the last number of a row: its contacts
  int total = 0;
  Kokkos::parallel_scan(
      "migration: starts of contacts", items(n),
      KOKKOS_LAMBDA(int g, int& sum, bool final) {
        sum += g < n_stay ? old.first(row(g) + 1) - old.first(row(g))
                          : static_cast<int>(received[(g - n_stay + 1) * width - 1]);
        if (final) first(g + 1) = sum;
      },
      total);
  history = {.first = first,
             .partner = of_size("contact history: partner", old.partner, total),
             .xi_t = of_size("contact history: xi_t", old.xi_t, total),
             .rolling = of_size("contact history: rolling", old.rolling, total),
             .force = of_size("contact history: force", old.force, total)};
  const ContactHistory now = history;
  Kokkos::parallel_for(
      "migration: contacts that stay", items(n_stay), KOKKOS_LAMBDA(int g) {
        for (int k = now.first(g); k < now.first(g + 1); ++k) {
          const int from = old.first(row(g)) + k - now.first(g);
          now.partner(k) = old.partner(from);
          now.xi_t(k) = old.xi_t(from);
          if (now.has_rolling()) now.rolling(k) = old.rolling(from);
          if (now.has_force()) now.force(k) = old.force(from);
        }
      });
  exchange_contacts_.unpack(layout_of(now), total - contacts_.n_from());
}

void GrainMigration::operator()(GrainState& grains, ContactHistory& history,
                                const SearchColumns& columns, const GrainOwners& owners,
                                const Kokkos::View<Quad*>& room) {
  choose(grains, columns, owners);
  count(grains, history, owners);
  const int n_to = grains_.n_to(), n_from = grains_.n_from();
  if (n_to == 0 && n_from == 0) return;
  PackLayout layout = layout_of(grains);
  layout.add(n_contacts_);
  exchange_.exchange(grains_, layout, leaving_);
  send_contacts(history);
  receive_contacts(history);

  permute(grains, row_, n_stay_, room);
  reserve_rows(grains, n_stay_ + n_from);
  exchange_.unpack(layout_of(grains), n_stay_);
  grains.n = n_stay_ + n_from;
}

}  // namespace barchan
