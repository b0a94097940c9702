// Grains that have come into columns of another rank go there, with all they remember.
#pragma once

#include "kernels/grains/contact_history.hpp"
#include "kernels/grains/grain_owners.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/particle_exchange.hpp"

namespace barchan {

/// Sends each grain to the rank that owns its place, with all its columns and the contacts kept
/// under it. Grains that stay keep their order; those that come follow in the order of their
/// senders.
class GrainMigration {
 public:
  /// `kept` holds the contacts under both of their grains; afterwards those of the new rows.
  /// `room`: as many as there are grains, overwritten. All ranks together.
  void operator()(GrainState& grains, ContactHistory& kept, const SearchColumns& columns,
                  const GrainOwners& owners, const Kokkos::View<Quad*>& room);

  /// Grains that have left this rank for another so far.
  std::int64_t n_sent() const { return n_sent_; }

  // Public only because nvcc takes no device lambda from a private function.
  void choose(const GrainState& grains, const SearchColumns& columns, const GrainOwners& owners);
  void count(const GrainState& grains, const ContactHistory& kept, const GrainOwners& owners);
  void send_contacts(const ContactHistory& kept);
  void take_contacts(ContactHistory& kept, int words) const;

 private:
  int n_stay_ = 0;
  Kokkos::View<int*> row_;      // old rows of the grains that stay
  Kokkos::View<int*> leaving_;  // and of those that leave, by rank
  Kokkos::View<int*> first_;    // (leaving) first contact record of each
  RecordCounts grains_, contacts_;
  MessageBuffer send_{"migration: send", 0}, receive_{"migration: receive", 0};
  MessageBuffer send_contacts_{"migration: send contacts", 0};
  MessageBuffer receive_contacts_{"migration: receive contacts", 0};
  std::int64_t n_sent_ = 0;
};

}  // namespace barchan
