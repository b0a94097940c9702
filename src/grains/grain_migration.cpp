#include "src/grains/grain_migration.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

using Rows = Kokkos::View<int*>;

Rows make_rows(const char* label, int n) { return Rows(label, static_cast<std::size_t>(n)); }

/// The history of a contact.
PackLayout layout_of(const ContactHistory& history) {
  PackLayout layout;
  const auto add = [&layout](const auto& array) {
    if (array.extent(0) > 0) layout.add(array);
  };
  add(history.partner), add(history.xi_t), add(history.rolling), add(history.force);
  return layout;
}

/// Room for the same of n contacts.
template <class View>
View room_like(const View& array, int n) {
  if (array.extent(0) == 0) return {};
  return View("contact history", static_cast<std::size_t>(std::max(n, 1)));
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
void GrainMigration::count(const GrainState& grains, const ContactHistory& history) {
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
  std::vector<int> to;
  const int* contact = host.data();
  for (const int n_grains : grains_.to) {
    to.push_back(std::accumulate(contact, contact + n_grains, 0));
    contact += n_grains;
  }
  std::exclusive_scan(host.data(), host.data() + n, host.data(), 0);
  first_ = contacts;
  Kokkos::deep_copy(first_, host);
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
  history = {first, room_like(old.partner, total), room_like(old.xi_t, total),
             room_like(old.rolling, total), room_like(old.force, total)};
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
  exchange_contacts_.unpack(layout_of(now), {}, total - contacts_.n_from());
}

void GrainMigration::operator()(GrainState& grains, ContactHistory& history,
                                const SearchColumns& columns, const GrainOwners& owners,
                                const Kokkos::View<Quad*>& room) {
  choose(grains, columns, owners);
  count(grains, history);
  const int n_to = grains_.n_to(), n_from = grains_.n_from();
  if (n_to == 0 && n_from == 0) return;
  PackLayout layout = layout_of(grains);
  layout.add(n_contacts_);
  exchange_.exchange(grains_, layout, leaving_);
  send_contacts(history);
  receive_contacts(history);

  permute(grains, row_, n_stay_, room);
  reserve_rows(grains, n_stay_ + n_from);
  exchange_.unpack(layout_of(grains), {}, n_stay_);
  grains.n = n_stay_ + n_from;
}

}  // namespace barchan
