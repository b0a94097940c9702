// Surfaces of grains that move, in the fluid step.
#pragma once

#include <memory>

#include "src/coupling/immersed_grains.hpp"
#include "src/fluid/flow_term.hpp"

namespace barchan {

/// Immersed boundary of direct forcing: markers on the surface of each grain give u* the velocity
/// that the grain has there, in some loops, before the pressure is solved. After the step it gives
/// each grain the force and torque of the water. Equations: docs/theory-resolved.md. Rows of cells
/// are equally high.
class ImmersedBoundary : public FlowTerm {
 public:
  ImmersedBoundary(const Grid& grid, Real density, Real r_max);

  /// Takes the grains of this rank as they are at the end of the fluid step that comes.
  void place(const GrainState& grains);
  /// Sets the momentum of the water inside them.
  void start(const FaceVector& u) { set_loads(u, 0); }

  void after_predict(const FlowStep& step) override;
  void after_correct(const FlowStep& step) override;
  void report(const DeviceReductions& numbers) override;

  /// Count of numbers, from kOfTerms on.
  static constexpr std::size_t numbers() { return 3; }
  /// Sum of the forces of the water on all grains in the last step [N].
  const Vec3& force_on_grains() const { return force_on_grains_; }

 private:
  void force(const FlowStep& step);
  void set_loads(const FaceVector& u, Real dt);

  Grid grid_;
  Real density_;  // of the water [kg/m^3]
  Real h_;        // width of a cell [m]
  Markers markers_;
  GrainPatch patch_, inside_;  // faces that markers reach; those inside a grain
  ImmersedGrains grains_;
  // The grains of this rank, and what they get.
  int n_own_ = 0;
  Kokkos::View<const GrainKinematics*> own_;
  ExchangeOnGrains exchange_;
  MarkerValues values_;
  Kokkos::View<ImpulseOnWater*> impulse_;  // of the markers of each grain
  Kokkos::View<WaterOfGrain*> water_;
  Vec3 force_on_grains_;
};

}  // namespace barchan
