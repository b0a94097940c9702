// Grains that have come into columns of another rank go there, with all they remember.
#pragma once

#include "kernels/grains/grain_owners.hpp"
#include "kernels/grains/neighbor_search.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/pack.hpp"

namespace barchan {

/// Sends each grain to the rank that owns its column, with all its arrays and its contact history.
/// Grains that stay keep their order; those that come follow in the order of their senders.
class GrainMigration {
 public:
  /// `history` holds contacts under both of their grains; afterwards those of the new rows.
  /// `room`: as many as there are grains, overwritten. All ranks together.
  void operator()(GrainState& grains, ContactHistory& history, const SearchColumns& columns,
                  const GrainOwners& owners, const Kokkos::View<Quad*>& room);

  /// Grains that have left this rank for another so far.
  std::int64_t n_sent() const { return n_sent_; }

  // Public only because nvcc takes no device lambda from a private function.
  void choose(const GrainState& grains, const SearchColumns& columns, const GrainOwners& owners);
  void count(const GrainState& grains, const ContactHistory& history);
  void send_contacts(const ContactHistory& history);
  void receive_contacts(ContactHistory& history) const;

 private:
  int n_stay_ = 0;
  Kokkos::View<int*> row_;          // old rows of the grains that stay
  Kokkos::View<int*> leaving_;      // and of those that leave, by rank
  Kokkos::View<int*> first_;        // (leaving) first of their contacts among all that leave
  Kokkos::View<Real*> n_contacts_;  // of each grain that leaves, by row
  ExchangeCounts grains_, contacts_;
  RowExchange exchange_{"migration"}, exchange_contacts_{"migration of contacts"};
  std::int64_t n_sent_ = 0;
};

}  // namespace barchan
