// Solver of the grains' equations of motion over the grain steps of one fluid step.
#pragma once

#include <variant>

#include "kernels/grains/grain_motion.hpp"
#include "kernels/grains/step_limit.hpp"
#include "kernels/grains/wall_shapes.hpp"
#include "src/grains/grain_kinds.hpp"
#include "src/grains/grains_on_bodies.hpp"
#include "src/grains/neighbor_list.hpp"
#include "src/grains/step_kernels.hpp"

namespace barchan {

/// Numbers about the contacts now.
struct ContactSummary {
  std::int64_t n_contacts = 0;  // contacts between grains
  Real max_overlap = 0;         // overlap over the mean diameter of the pair [-]
};

/// A wall with its history among the others. Throws std::length_error beyond kMaxWalls.
void add_wall(WallShapes& walls, const Plane& plane, int history);

/// Discrete-element method: Verlet list, contact laws chosen once, velocity Verlet. All ranks that
/// share the grains call every member together, and counts are those of all of them.
class GrainSolver {
 public:
  /// Sets up laws, walls and their history. Then call start() or, for entries read from a restart,
  /// list().restore().
  GrainSolver(const GrainsCase& config, GrainState& grains);
  /// Sets up laws of other kinds than the case's (for tests). GrainState::kind holds them where
  /// they are several.
  GrainSolver(const GrainsCase& config, GrainState& grains, const GrainKinds& kinds);
  /// Builds the first list.
  void start(GrainState& grains) { list_.rebuild(grains, true); }

  /// Advances the grains by n grain steps of dt [s] with the fluid side of `grains` held fixed.
  /// Equals n calls of one grain step, bit for bit.
  void advance(GrainState& grains, int n, Real dt);
  /// Drops the grains that have passed the outlet (counted in n_left of their rank).
  void remove_left(GrainState& grains) { list_.drop_left(grains); }
  /// Number and largest overlap of the contacts in the last grain step.
  ContactSummary contacts(const GrainState& grains) const;
  /// Longest grain step for which contacts are stable [s]; infinite without contacts or friction.
  Real stable_step(const GrainState& grains) const;
  /// Normal and tangential contact force of each grain in the last grain step [N]; throws
  /// std::logic_error without output.grain_forces.
  void split_contacts(const GrainState& grains, const Kokkos::View<Vec3*>& normal,
                      const Kokkos::View<Vec3*>& tangential) const;
  NeighborList& list() { return list_; }
  const NeighborList& list() const { return list_; }
  const PeriodicBox& box() const { return list_.box(); }
  const WallShapes& walls() const { return walls_; }
  const Bodies& bodies() const { return on_bodies_.bodies(); }
  /// Load of the grains of all ranks on each body in the last call of advance(). All ranks call it
  /// together.
  std::vector<GrainsOnBody> body_loads() const { return on_bodies_.loads(ranks_); }
  /// Sets the number of grain steps that are launched before the host waits and looks whether the
  /// list still holds; the results do not depend on it.
  void set_sub_steps_ahead(int n) { ahead_ = n; }
  /// Lets a device take all grain steps of a fluid step in one launch where that pays; the results
  /// do not depend on it.
  void set_graphs(bool on) { makes_graphs_ = on && !kOnHost; }

 private:
  using DeviceMemory = Kokkos::DefaultExecutionSpace::memory_space;
  /// Reduction into the element of a grain step, without a wait.
  Kokkos::Max<Real, DeviceMemory> max_excess(int step) const {
    return Kokkos::Max<Real, DeviceMemory>(Kokkos::View<Real, DeviceMemory>(excess_.data() + step));
  }
  void add_walls(const GrainsCase& config, Real r_max);
  void kick_and_drift(const GrainState& grains, int n, Real dt);
  void grain_step(const GrainState& grains, int s, bool last, Real dt);
  template <class Stiffness, bool many, class Rolling>
  void launch(const GrainState& grains, const LawTable<Stiffness, many>& of_pairs,
              const LawTable<Stiffness, many>& of_walls, const Rolling& rolling, int s, bool last,
              Real dt);
  template <Moves moves>
  void move_clumps(const GrainState& grains, int s, Real dt);
  template <class Launch>
  void with_laws(const Launch& launch) const;
  Real strongest_on_body(Real r_max) const;
  void rebuild(GrainState& grains, int s);
  void update_ghosts(GrainState& grains, int s);
  bool prepare_graph(const GrainState& grains, int n, Real dt);
  int launch_ahead(GrainState& grains, int s, int n, Real dt);

  MPI_Comm ranks_;
  bool many_kinds_;
  LawTables pair_laws_, wall_laws_;
  NeighborList list_;
  RollingModels::Variant rolling_;
  WallShapes walls_;
  GrainsOnBodies on_bodies_;
  int ahead_ = kOnHost ? 1 : 16;
  bool makes_graphs_ = !kOnHost;
  StepKernels kernels_;
  struct GraphOf {
    std::int64_t rebuilds = -1;
    int n = 0;
    Real dt = 0;
    bool operator==(const GraphOf&) const = default;
  } graph_of_;
  std::int64_t rebuilds_before_ = -1;  // rebuilds when the last fluid step began
  // Largest squared displacement beyond the skin of a grain as a grain step begins [m^2].
  Kokkos::View<Real*> excess_;
  Kokkos::View<Real*>::host_mirror_type host_excess_;
};

/// Calls launch(laws of pairs, laws of walls) with the tables of this case; a case of one kind has
/// a single law.
template <class Launch>
void GrainSolver::with_laws(const Launch& launch) const {
  std::visit(
      [&](const auto& pairs) {
        const auto& walls = std::get<std::decay_t<decltype(pairs)>>(wall_laws_);
        if (many_kinds_) {
          launch(pairs, walls);
        } else {
          launch(only_law(pairs), only_law(walls));
        }
      },
      pair_laws_);
}

}  // namespace barchan
