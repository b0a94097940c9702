// From the flow to the grains.
#pragma once

#include "kernels/coupling/deposit.hpp"
#include "kernels/coupling/gather.hpp"
#include "src/coupling/coupling_fields.hpp"
#include "src/coupling/ledger.hpp"

namespace barchan {

/// Velocity, share of fluid, drag coefficient and steady forces of the fluid at each grain, before
/// the grain steps of a fluid step. Grid and fields outlive it.
class Gather {
 public:
  Gather(const Config& config, const GrainState& grains, const CouplingGrid& grid,
         CouplingFields& fields);

  /// First of all: the fraction before the smoothing.
  void undo_smoothing(const FluidState& fluid);
  /// Books what the flow's pressure gradient and stress do.
  void operator()(const FluidState& fluid, GrainState& grains, Real dt, const ExchangeSums& sums);
  /// The next step is the first of grains that have just been placed.
  void start() { is_first_step_ = true; }

 private:
  void reserve_flow_at(int n);
  void pressure_gradient(const FluidState& fluid, const GrainState& grains,
                         const ExchangeSums& sums);
  void smoothed_pressure_gradient(const FluidState& fluid, const ExchangeSums& sums);
  void stress(const FluidState& fluid, const GrainState& grains, const ExchangeSums& sums);
  void fill_faces_beside(FaceVector& force, const Region& cells) const;
  void to_cells(const FaceVector& force, const Field& alpha, const Region& cells,
                CellVector& in_cells, const ExchangeSums& sums, ExchangeSums::Sum sum) const;
  void at_centres(const FaceVector& force, const GrainState& grains,
                  const Kokkos::View<Vec3*>& at) const;
  void flow_at_grains(const FluidState& fluid, const GrainState& grains);
  void flow_of_cfdem(const FluidState& fluid, const GrainState& grains);
  void drag_and_share(const GrainState& grains, Real dt) const;
  void lift_and_torque(const FluidState& fluid, const GrainState& grains) const;

  const CouplingGrid& grid_;
  CouplingFields& fields_;
  FluidForces forces_;
  DragLaws::Variant drag_;
  SubmergedWeight weight_;
  Real rho_f_, nu_;
  bool has_floor_;       // no slip at y = 0
  bool reads_as_cfdem_;  // from the centres of cells
  bool is_first_step_ = false;
  FlowAtGrains flow_at_;
};

}  // namespace barchan
