// How flow and grains exchange volume and momentum, once per fluid step.
#pragma once

#include <memory>

#include "src/coupling/ledger.hpp"
#include "src/fluid/exchange_on_faces.hpp"
#include "src/fluid/fluid_solver.hpp"

namespace barchan {

/// One of the schemes of coupling.scheme: gather before the grain steps, deposit after them. Where
/// the grid is cut, `grains` are those whose centres lie in this rank's pencil (FluidSideGrains),
/// and all ranks call every member together.
class ExchangeScheme {
 public:
  virtual ~ExchangeScheme() = default;

  /// alpha_f and alpha_f_previous of grains that have just been placed.
  virtual void start(const GrainState& grains, FluidState& fluid) = 0;
  /// What the flow does to each grain in the grain steps of a fluid step of dt [s].
  virtual void gather(const FluidState& fluid, GrainState& grains, Real dt) = 0;
  /// alpha_f, its old value in alpha_f_previous; the reaction to the grains' impulse.
  virtual void deposit(const GrainState& grains, FluidState& fluid, Real dt) = 0;

  /// What the flow has to take into account, since the last deposit.
  virtual const ExchangeOnFaces& on_faces() const = 0;
  /// What changed sides in the last step.
  virtual const ExchangeLedger& ledger() const = 0;
};

/// The scheme that a case names.
std::unique_ptr<ExchangeScheme> make_exchange_scheme(const Config& config,
                                                     const FluidSolver& solver,
                                                     const GrainState& grains, const Grid& grid);

}  // namespace barchan
