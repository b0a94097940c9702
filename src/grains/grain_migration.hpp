// Migration: grains that have come into columns of another rank go there, with their history.
#pragma once

#include "kernels/grains/neighbor_search.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/pack.hpp"

namespace barchan {

/// Sends each grain to the rank that owns its column, with all its arrays and its contact history.
/// Grains that stay keep their order; those that come follow in the order of their senders.
class GrainMigration {
 public:
  /// Migrates grains. `history` holds contacts under both of their grains; afterwards those of the
  /// new entries. `room`: as many as there are grains, overwritten. All ranks call it together.
  void operator()(GrainState& grains, ContactHistory& history, const SearchColumns& columns,
                  const GrainOwners& owners, const Kokkos::View<Vec4*>& room);

  /// Number of grains that have left this rank for another so far.
  std::int64_t n_sent() const { return n_sent_; }

 private:
  EntryExchange exchange_{"migration"}, exchange_contacts_{"migration of contacts"};
  std::int64_t n_sent_ = 0;
};

}  // namespace barchan
