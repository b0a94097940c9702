// Checks after each fluid step that a run has not gone wrong, with place and cause if it has.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "kernels/diagnostics/state_checks.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/parallel/device_reductions.hpp"

namespace barchan {

/// Limits of a sound state beside grains.max_overlap. They are far from the values of a good run (a
/// CFL number of 0.5), and near enough to stop before results are ruined unseen.
inline constexpr Real kMaxDisplacement = 0.5;  // displacement of a grain in a grain step, in radii
inline constexpr Real kMaxCourant = 1;         // CFL number of the flow
inline constexpr Real kFractionSlack = 1e-9;   // slack of the fluid fraction around (0, 1]

/// Checks of the state. All ranks call every member together.
class StateChecks {
 public:
  StateChecks(const CoupledCase& config, MPI_Comm ranks) : config_(config), ranks_(ranks) {}

  /// Checks the flow and the grains after a step, in one reduction over ranks. Throws StateError
  /// when a grain or the flow is not finite, grains overlap too much, go through a wall or too far
  /// in a grain step, alpha_f leaves (0, 1], the CFL number is beyond stability, or the pressure
  /// equation was not solved.
  void check(const SystemState& state, const CoupledStep& step) const;
  /// Checks a state that a run starts from. Throws InputError: it came from `source`.
  void check_start(const SystemState& state, const CoupledStep& step,
                   const std::string& source) const;

 private:
  /// Worst values on this rank, and their places.
  struct Worst {
    WorstItem pair{0, -1};
    WorstGrains grains;
    Real fraction = 0;
  };
  enum Slot : int { kPair = 0, kGrains = 2, kFraction = 6, kSlots };
  Worst worst_here(const SystemState& state, const CoupledStep& step, bool grains_move) const;
  std::string flow_problem(const FluidState& fluid, const FluidStepReport& report,
                           Real fraction_outside, bool at_start) const;
  std::string problem_of(const SystemState& state, const CoupledStep& step, bool at_start) const;

  CoupledCase config_;
  MPI_Comm ranks_;
  DeviceReductions worst_{"state checks: worst", kSlots};
};

}  // namespace barchan
