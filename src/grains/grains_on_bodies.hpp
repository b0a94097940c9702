// Bodies among the grains: the grains near them, and the forces between them.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/grains/body_contact.hpp"
#include "src/bodies/body_load.hpp"
#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Load of all grains on a body: the mean over the grain steps of the last fluid step, with
/// positions at the end of each; and the contacts at the end of the last one.
struct GrainsOnBody {
  BodyLoad load;
  std::int64_t contacts = 0;
};

/// Contacts of grains with bodies. It lists the pairs near each other after each rebuild of the
/// neighbour list.
class GrainsOnBodies {
 public:
  /// Allocates the history of contacts if the case has bodies.
  /// `law_reach`: of the contact law between two surfaces [m].
  GrainsOnBodies(const GrainsCase& config, GrainState& grains, bool with_rolling,
                 Real law_reach = 0);

  bool any() const { return bodies_.n > 0; }
  const Bodies& bodies() const { return bodies_; }
  const NearBodies& near() const { return near_; }
  /// Sum of each grain's contacts with bodies; empty without bodies.
  const Kokkos::View<ContactSum*>& sums() const { return sums_; }

  /// Begins a fluid step of n grain steps: nothing has pushed the bodies yet. No pair of a grain
  /// and a body pushes harder than `strongest` [N].
  void begin(const GrainState& grains, int n, Real strongest);
  /// Finds the pairs for the list of this number of rebuilds, if that is not done yet.
  void find(const GrainState& grains, std::int64_t rebuilds);
  /// Loads over all ranks, with the same bits on each, and for any number of ranks if the forces on
  /// the grains are the same. All ranks call it together.
  std::vector<GrainsOnBody> loads(MPI_Comm ranks) const;

 private:
  void sum_pairs() const;

  Bodies bodies_;
  Real law_reach_ = 0;
  Real farthest_ = 0;  // largest distance of a contact from a foot [m]
  NearBodies near_;
  std::int64_t found_at_ = -1;  // rebuilds of the neighbour list
  int n_steps_ = 0;
  Real per_force_ = 1, per_torque_ = 1, most_ = 0;
  Kokkos::View<std::uint8_t*> marks_;
  Kokkos::View<ContactSum*> sums_;
  Kokkos::View<std::int64_t * [NearBodies::kParts]> totals_;
  Kokkos::View<std::int64_t*> contacts_;
};

}  // namespace barchan
