// Centred exchange: a grain feels the flow at its centre, and the cells of its volume lose what it
// gets.
#pragma once

#include "src/coupling/unresolved_exchange.hpp"

namespace barchan {

/// Exchange of the schemes "centred" and, where the loss is smoothed as the fluid fraction is,
/// "smoothed".
class CentredExchange : public UnresolvedExchange {
 public:
  CentredExchange(const FlowAndGrains& of, VoidFraction void_fraction, bool smooths);

  void gather(const FluidState& fluid, GrainState& grains, Real dt) override;
  void deposit(const GrainState& grains, FluidState& fluid, Real dt) override;

 protected:
  CentredExchange(const FlowAndGrains& of, const GrainVolume& volume, bool smooths)
      : UnresolvedExchange(of, volume, false), smooths_(smooths) {}

  virtual void flow_at_grains(const FluidState& fluid, const GrainState& grains);

 private:
  void pressure_gradient(const FluidState& fluid, const GrainState& grains);
  void stress(const FluidState& fluid, const GrainState& grains);
  void at_centres(const FaceVector& force, const GrainState& grains,
                  const Kokkos::View<Vec3*>& at) const;
  void find_faces();
  void to_faces();

  bool smooths_;
};

}  // namespace barchan
