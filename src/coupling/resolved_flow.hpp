// Flow resolved around each grain: a reference for the unresolved schemes.
#pragma once

#include <vector>

#include "src/coupling/exchange_scheme.hpp"

namespace barchan {

/// Scheme "resolved": the flow goes round each grain as it does round a body, on cells far smaller
/// than a grain. There is no fraction and no drag law: force and torque of each grain are those of
/// the fluid on its surface. Grains are frozen: their faces are found once.
class ResolvedFlow : public ExchangeScheme {
 public:
  ResolvedFlow(const CoupledCase& config, FluidSolver& solver, const Grid& grid);

  void start(const GrainState& grains, FluidState& fluid) override;
  void gather(const FluidState& fluid, GrainState& grains, Real dt) override;
  void deposit(const GrainState&, FluidState&, Real) override {}
  /// Gives the grains force and torque of the last fluid step, with weight and buoyancy.
  void close(GrainState& grains, Real dt) override;

  const ExchangeOnFaces* on_faces() const override { return nullptr; }
  const ExchangeLedger& ledger() const override { return ledger_; }

 private:
  void place(const GrainState& grains);
  void find_loads_of(const GrainState& grains);

  FluidSolver& solver_;
  Grid grid_;
  Bodies bodies_;
  Vec3 gravity_;
  Real density_;  // density of the liquid [kg/m^3]
  bool placed_ = false;
  FrozenGrains frozen_;                 // grains of all ranks
  Kokkos::View<int*> load_of_;          // index of each grain of this rank among all
  Kokkos::View<Vec3*> force_, torque_;  // on all grains [N], [N m]
  Kokkos::View<Vec3*>::host_mirror_type force_on_host_, torque_on_host_;
  ExchangeLedger ledger_;
};

}  // namespace barchan
