// Surfaces of grains that move, in the fluid step.
#pragma once

#include <memory>

#include "kernels/coupling/inner_momentum.hpp"
#include "src/fluid/flow_term.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Immersed boundary of direct forcing: markers on the surface of each grain give u* the velocity
/// that the grain has there, in some loops, before the pressure is solved. After the step it gives
/// each grain the force and torque of the water. Equations: docs/theory-resolved.md. One rank has
/// all cells, and its rows are equally high.
class ImmersedBoundary : public FlowTerm {
 public:
  ImmersedBoundary(const Grid& grid, Real density, Real r_max);

  /// Takes grains as they are at the end of the fluid step that comes.
  void place(const GrainState& grains);
  /// Sets the momentum of the water inside them.
  void start(const FaceVector& u) const { set_loads(u, 0); }

  void after_predict(const FlowStep& step) override;
  void after_correct(const FlowStep& step) override;
  void report(const DeviceReductions& numbers) override;

  /// Count of numbers, from kOfTerms on.
  static constexpr std::size_t numbers() { return 3; }
  /// Sum of the forces of the water on all grains in the last step [N].
  const Vec3& force_on_grains() const { return force_on_grains_; }

 private:
  void force(const FlowStep& step) const;
  void set_loads(const FaceVector& u, Real dt) const;

  Grid grid_;
  Real density_;  // of the water [kg/m^3]
  Real h_;        // width of a cell [m]
  Markers markers_;
  GrainPatch patch_, inside_;  // faces that markers reach; those inside a grain
  int n_grains_ = 0;
  ExchangeOnGrains exchange_;
  MarkerValues values_;
  Kokkos::View<ImpulseOnWater*> impulse_;  // of the markers of each grain
  Kokkos::View<WaterOfGrain*> water_;
  Vec3 force_on_grains_;
};

}  // namespace barchan
