// Exchange of volume and momentum between flow and grains, once per fluid step.
#pragma once

#include <memory>

#include "src/coupling/coupling_case.hpp"
#include "src/coupling/ledger.hpp"
#include "src/fluid/exchange_on_faces.hpp"
#include "src/fluid/fluid_solver.hpp"

namespace barchan {

/// Scheme of coupling.scheme: gather before the grain steps, deposit after them. Where the grid is
/// cut, `grains` are those whose centres lie in this rank's pencil (FluidSideGrains), and all ranks
/// call every member together.
class ExchangeScheme {
 public:
  virtual ~ExchangeScheme() = default;

  /// Sets alpha_f and alpha_f_previous of grains that have just been placed.
  virtual void start(const GrainState& grains, FluidState& fluid) = 0;
  /// Sets the action of the fluid on each grain in the grain steps of a fluid step of dt [s].
  virtual void gather(const FluidState& fluid, GrainState& grains, Real dt) = 0;
  /// Sets alpha_f and its old value, alpha_f_previous; on faces the reaction to the impulse.
  virtual void deposit(const GrainState& grains, FluidState& fluid, Real dt) = 0;

  /// Completes the exchange after the flow's step of dt, for the grains of this rank; most schemes
  /// have nothing to do.
  virtual void close(GrainState&, Real) {}

  /// Exchange on the faces of the flow, since the last deposit; nullptr: none.
  virtual const ExchangeOnFaces* on_faces() const = 0;
  /// Momentum and volume that changed sides in the last step.
  virtual const ExchangeLedger& ledger() const = 0;
};

/// Makes the scheme that a case names.
std::unique_ptr<ExchangeScheme> make_exchange_scheme(const CoupledCase& config, FluidSolver& solver,
                                                     const GrainState& grains, const Grid& grid);

}  // namespace barchan
