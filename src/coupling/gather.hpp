// Gather: forces of the flow on the grains.
#pragma once

#include "kernels/coupling/deposit.hpp"
#include "kernels/coupling/gather.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/coupling/coupling_fields.hpp"
#include "src/coupling/ledger.hpp"

namespace barchan {

/// Gather of the forces of the flow on solid in cells, and of drag coefficient, share of fluid and
/// steady forces of each grain, from the flow that a scheme finds there. Grid and fields outlive
/// it.
class Gather {
 public:
  Gather(const CoupledCase& config, const GrainState& grains, const CouplingGrid& grid,
         CouplingFields& fields, bool layers);

  /// Makes the next step the first of grains that have just been placed.
  void start() { is_first_step_ = true; }
  /// Reserves memory for the flow at the grains; first of all.
  void reserve_flow(const GrainState& grains);
  /// Sets the fraction before the smoothing.
  void undo_smoothing(const FluidState& fluid);

  // Forces per volume of solid [N/m^3]. What the solid takes is booked.

  /// Sets the force density of the pressure gradient, on faces and in cells.
  void pressure_on_solid(const FluidState& fluid, const ExchangeSums& sums) const;
  /// Sets the force density of the stress on faces, and the convective acceleration.
  void stress_and_convection(const FluidState& fluid, const Region& cells) const;
  /// Sets the force density of the stress in cells, on the solid 1 - alpha; after
  /// stress_and_convection().
  void stress_on_solid(const Field& alpha, const ActiveRegion& where,
                       const ExchangeSums& sums) const;

  /// Sets the action on the grains in the flow that the scheme has found at each; call it last.
  /// Books the forces of pressure gradient and stress on them.
  void act_on(GrainState& grains, Real dt, const ExchangeSums& sums);

  const FlowAtGrains& flow() const { return flow_at_; }
  const FluidForces& forces() const { return forces_; }
  Real rho_f() const { return rho_f_; }
  /// Stresslet of the grains; none unless the exchange has layers and the case asks for it.
  Stresslet stresslet() const {
    return {.mu_f = layers_ && forces_.mixture_viscosity ? rho_f_ * nu_ : 0};
  }

 private:
  void fill_faces_beside(FaceVector& force, const Region& cells) const;
  void to_cells(const FaceVector& force, const Field& alpha, const Region& cells,
                CellVector& in_cells, const ExchangeSums& sums, ExchangeSums::Sum sum) const;
  void drag_and_share(const GrainState& grains, Real dt) const;
  void lift_and_torque(const GrainState& grains) const;

  const CouplingGrid& grid_;
  CouplingFields& fields_;
  FluidForces forces_;
  DragLaws::Variant drag_;
  ShapeFactor shape_;
  SubmergedWeight weight_;
  Real rho_f_, nu_;
  bool has_floor_;  // no slip at y = 0
  bool layers_;     // the exchange has layers
  bool is_first_step_ = false;
  FlowAtGrains flow_at_;
};

}  // namespace barchan
