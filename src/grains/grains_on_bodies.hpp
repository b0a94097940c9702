// The bodies among the grains: which grains are near them, and what grains do to them.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/grains/body_contact.hpp"
#include "src/bodies/body_load.hpp"
#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// What all grains do to a body: load as a mean over the grain steps of the last fluid step, taken
/// at the position that each of them ends with; contacts at the end of the last one.
struct GrainsOnBody {
  BodyLoad load;
  std::int64_t contacts = 0;
};

/// Lists the pairs of grains and bodies near each other after each rebuild of the neighbour list.
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

  /// A fluid step of n grain steps begins: nothing has pushed the bodies yet. No pair of a grain
  /// and a body pushes harder than `strongest` [N].
  void begin(const GrainState& grains, int n, Real strongest);
  /// Pairs of the list of this number of rebuilds, if they are not there yet.
  void find(const GrainState& grains, std::int64_t rebuilds);
  /// Over all ranks, the same bits on each and for any number of them as far as the forces on the
  /// grains are. All ranks together.
  std::vector<GrainsOnBody> loads(MPI_Comm ranks) const;

 private:
  void sum_pairs() const;

  Bodies bodies_;
  Real law_reach_ = 0;
  Real farthest_ = 0;  // farther from a foot no contact is [m]
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
