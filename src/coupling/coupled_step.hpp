// One fluid step with the grains' grain steps inside it: the algorithm of the whole program.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernels/coupling/still_fluid.hpp"
#include "src/base/stopwatch.hpp"
#include "src/coupling/clumps_in_flow.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/coupling/exchange_scheme.hpp"
#include "src/coupling/fluid_side_grains.hpp"
#include "src/coupling/system_state.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/grains/grain_feed.hpp"
#include "src/grains/grain_solver.hpp"

namespace barchan {

/// Unresolved CFD-DEM, model A; also a pure flow or pure grains.
class CoupledStep {
 public:
  CoupledStep(const CoupledCase& config, SystemState& state);

  /// First neighbour list and fluid fraction of a new run.
  void start(SystemState& state);
  /// t -> t + fluid_step: the grains move through the flow of time t, then the flow answers.
  void advance(SystemState& state);

  // The parts of a step in their order. What a state does not have, they leave out.

  /// u_f, share of fluid, drag coefficient and steady forces at the grains, of the flow or of still
  /// fluid.
  void gather(SystemState& state);
  /// The grain steps of one fluid step; the drag follows the grain and its share of fluid.
  void move_grains(SystemState& state) { move_grains(state, n_substeps_); }
  /// The first n of them.
  void move_grains(SystemState& state, int n);
  /// alpha_f; on faces the reaction to the grains' impulse.
  void deposit(SystemState& state);
  /// WALE, u*, p, u.
  void advance_fluid(SystemState& state);
  /// The conservation ledger; grains beyond the outlet leave, others are fed.
  void close_step(SystemState& state);

  const FluidStepReport& fluid_report() const { return fluid_report_; }
  /// Exchange between flow and grains in the last step; ledger(): since the run began.
  const ExchangeLedger& exchange() const { return exchange_->ledger(); }
  const Ledger& ledger() const { return ledger_; }
  /// Impulse of the flow on all grains in the last step [N s].
  Vec3 impulse_on_grains() const;
  const Phases& phases() const { return phases_; }
  int substeps() const { return n_substeps_; }
  /// Length of a fluid step [s].
  Real dt() const { return dt_; }

  /// Solvers of flow and grains; null for a part that the state does not have.
  const FluidSolver* fluid_solver() const { return fluid_.get(); }
  const GrainSolver* grain_solver() const { return grains_.get(); }
  NeighborList* neighbor_list() { return grains_ ? &grains_->list() : nullptr; }
  const NeighborList* neighbor_list() const { return grains_ ? &grains_->list() : nullptr; }

 private:
  double dt_ = 0;
  int n_substeps_ = 1;
  bool frozen_ = false;
  GatherStillFluid still_;
  std::unique_ptr<FluidSolver> fluid_;
  std::unique_ptr<GrainSolver> grains_;
  std::optional<GrainFeed> feed_;
  std::unique_ptr<ExchangeScheme> exchange_;
  ClumpsInFlow clumps_;
  FluidSideGrains fluid_side_;
  FluidStepReport fluid_report_;
  Ledger ledger_;
  Phases phases_;
};

}  // namespace barchan
