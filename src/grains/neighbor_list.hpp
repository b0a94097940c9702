// Verlet list: when to rebuild it, and how.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernels/grains/grain_sums.hpp"
#include "kernels/grains/neighbor_search.hpp"
#include "src/base/scratch_memory.hpp"
#include "src/grains/clump_members.hpp"
#include "src/grains/ghost_grains.hpp"
#include "src/grains/grain_migration.hpp"
#include "src/grains/grain_partition.hpp"
#include "src/grains/grain_skins.hpp"
#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Grain that comes in, or a sphere of a clump that does: its number, body, and centre [m].
struct NewGrain {
  std::int64_t id = 0;
  GrainBody body;
  Vec3 x;
  ClumpMotion clump = {};  // where there are clumps
};

/// Half Verlet list with a skin around each grain (SetSkins), valid until a grain has moved its
/// skin from where it was at the last rebuild. A rebuild sorts the grains in space, keeps the
/// contact history and, when asked, drops grains that leave. Throws StateError naming the grain if
/// a position is not finite.
/// With several ranks a rebuild also sends grains to the rank that owns their columns, and the list
/// holds the pairs of owned grains with each other and with ghosts. Both ranks of a pair evaluate
/// it, with the same bits: which grain is the first depends on the places of the two columns alone.
class NeighborList {
 public:
  /// Makes an empty list. `reach`: of the contact law between two surfaces; `longest_arm`: from the
  /// centre of a clump to that of its farthest sphere [m].
  NeighborList(const GrainsCase& config, Real r_max, MPI_Comm ranks = MPI_COMM_SELF, Real reach = 0,
               const LongestArm& longest_arm = {});

  /// Sorts, searches, carries the history over. `drop` removes grains that leave. The first rebuild
  /// throws std::logic_error where clumps have not come as their spheres, by as_spheres().
  void rebuild(GrainState& grains, bool drop);
  /// Rebuilds the list without the grains that leave, if there are any.
  void drop_left(GrainState& grains);
  /// Rebuilds the list with new grains, or all spheres of new clumps: at rest, without contacts.
  /// The first of all ranks takes them and gives them to those that own their columns.
  void bring_in(GrainState& grains, const std::vector<NewGrain>& come);
  /// Condition for the grains that leave now.
  CountLeaving leaving(const GrainState& grains) const {
    return {{grains.kin, grains.clump}, lx_, half_strip_, grains.window_edge};
  }
  /// Searches again from x_reference in the present order: gives the list of the last rebuild, with
  /// its contact history. If the skin has changed (grains.skin), it is a new list. All ranks call
  /// it together, as many as there were.
  void restore(GrainState& grains);
  /// Sets the contacts that the next rebuild or restore carries over, as a restart file has them,
  /// under the present entries of `grains`.
  void set_history(const ContactHistory& history) { history_ = history, has_history_ = true; }
  /// Brings the ghosts to where their owners have moved them. All ranks call it together.
  void update_ghosts(const GrainState& grains) const {
    if (ranks_) ranks_->ghosts.update(grains.kin);
  }
  /// Partition of the grains; nullptr where one rank has all of them.
  GrainPartition* partition() const { return ranks_ ? &ranks_->partition : nullptr; }
  const GhostGrains* ghosts() const { return ranks_ ? &ranks_->ghosts : nullptr; }
  std::int64_t n_migrated() const { return ranks_ ? ranks_->migrate.n_sent() : 0; }
  /// Distance that a grain at rest may go until active pairs are looked for again [m].
  Real min_slack() const { return skins_.least() / 100; }
  std::int64_t rebuilds() const { return rebuilds_; }
  /// Wall time of all rebuilds so far.
  double seconds() const { return seconds_; }
  /// Gives memory that nobody else uses during a call of rebuild or restore. They use it, as far as
  /// it goes, for arrays that they need only until they return.
  void use_scratch(ScratchMemory memory) { scratch_ = std::move(memory); }
  bool with_rolling = false;  // keep a rolling torque per pair
  bool with_laws = false;     // kinds of grains: each pair has its law
  bool with_force = false;    // keep the force of each pair in the last grain step
  const PeriodicBox& box() const { return box_; }

  // Parts of a rebuild; public only because nvcc takes no device lambda from a private function.
  void sort(GrainState& grains, bool drop);
  void wrap(const GrainState& grains) const;

 private:
  void collect_history(const GrainState& grains);
  void append_new(GrainState& grains);
  void redistribute(GrainState& grains);
  Windows find_windows(const Kokkos::View<GrainKinematics*>& grains, int n);
  void reserve_pairs(PairList& list) const;
  void search(GrainState& grains);
  template <class Finder>
  void find_pairs(GrainState& grains, const Finder& search);
  void find_ghosts_and_pairs(GrainState& grains);
  void take_memory(const GrainState& grains);
  void reserve_memory(int n);

  struct Ranks {
    explicit Ranks(MPI_Comm all) : partition(all) {}
    GrainPartition partition;
    GrainMigration migrate;
    GhostGrains ghosts;
  };

  SearchColumns columns_;
  PeriodicBox box_;
  GrainSkins skins_;
  Real lx_ = 0;
  bool leaves_x_ = false;      // grains leave along x,
  Real half_strip_ = 0;        // half the strip around the edge [m]; 0: they leave at both ends
  std::vector<NewGrain> new_;  // new grains of the present rebuild
  std::int64_t rebuilds_ = 0;
  double seconds_ = 0;
  OccupiedColumns occupied_;
  std::unique_ptr<Ranks> ranks_;
  ContactHistory history_;
  bool has_history_ = false;
  // entry of each grain in history_; before that, the next free slot there
  Kokkos::View<int*> entry_;
  // Reused memory: of each grain for reordering, then for its noted partners; for sort keys, then
  // windows, then the next free entry of incoming pairs.
  Kokkos::View<Vec4*> grain_memory_;
  Kokkos::View<std::uint64_t*> key_memory_;  // two for each grain
  OrderOfPlaces order_;                      // with clumps on several ranks
  ScratchMemory scratch_;
};

}  // namespace barchan
