// One fluid step with the grains' sub-steps inside it: the algorithm of the whole program.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "src/base/stopwatch.hpp"
#include "src/config/config.hpp"
#include "src/coupling/conservation.hpp"
#include "src/coupling/coupling.hpp"
#include "src/coupling/fluid_side_grains.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/grains/grain_solver.hpp"
#include "src/grains/named_force.hpp"

namespace barchan {

/// What a run is made of; either part may be missing.
struct SystemState {
  std::optional<FluidState> fluid;
  std::optional<GrainState> grains;
};

/// Unresolved CFD-DEM, model A; also a pure flow or pure grains.
class CoupledStep {
 public:
  CoupledStep(const Config& config, SystemState& state);

  /// First neighbour list and fluid fraction of a new run.
  void start(SystemState& state);
  /// t -> t + fluid_step.
  void advance(SystemState& state);

  /// Forces on the grains over the last step by name [N], rows as in the state: drag, pressure
  /// gradient, stress, added mass (with the impulse carried from the implicit exchange), contact
  /// normal and tangential, and total, the resultant with weight and buoyancy.
  std::vector<NamedForce> grain_forces(SystemState& state);
  /// The last of them alone.
  Kokkos::View<Vec3*> resultant_force(const GrainState& grains) const;
  /// Its mean over the last step, what changed the grains' momentum in water; without, the same as
  /// above. Contacts of one grain step alone would be mostly vibration.
  Kokkos::View<Vec3*> mean_resultant_force(const GrainState& grains) const;

  const FluidStepReport& fluid_report() const { return fluid_report_; }
  const Ledger& ledger() const { return ledger_; }
  const Phases& phases() const { return phases_; }
  FluidSolver* fluid_solver() { return fluid_.get(); }
  GrainSolver* grain_solver() const { return grains_.get(); }
  Coupling* coupling() { return coupling_.get(); }
  int substeps() const { return n_substeps_; }

 private:
  void advance_coupled(FluidState& fluid, GrainState& grains);
  void advance_grains(GrainState& grains);
  void move_grains(GrainState& grains);
  Kokkos::View<Vec3*> fluid_force_now(const char* name, const FluidForces& which,
                                      SystemState& state);

  double dt_ = 0;
  int n_substeps_ = 1;
  bool frozen_ = false;
  GatherStillFluid still_;
  std::unique_ptr<FluidSolver> fluid_;
  std::unique_ptr<GrainSolver> grains_;
  std::unique_ptr<Coupling> coupling_;
  FluidSideGrains fluid_side_;
  FluidStepReport fluid_report_;
  Ledger ledger_;
  Phases phases_;
};

}  // namespace barchan
