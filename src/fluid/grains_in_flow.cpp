#include "src/fluid/grains_in_flow.hpp"

#include "kernels/fluid/interlayer_drag.hpp"

namespace barchan {

GrainsInFlow::GrainsInFlow(const Grid& grid, Real density)
    : grid_(grid), density_(density), anywhere_(grid), fraction_alone_(grid) {
  fraction_alone_.exchange.set({});
}

const FlowRegions* GrainsInFlow::regions() const {
  if (exchange_ == &none_) return &fraction_alone_;
  return exchange_->regions != nullptr ? exchange_->regions : &anywhere_;
}

void GrainsInFlow::after_predict(const FlowStep& step) {
  if (exchange_->interlayer_drag_x.storage.size() == 0) return;
  const Region& rows = regions()->exchange;
  for (const bool along_x : {true, false}) {
    const Field& interlayer_drag =
        along_x ? exchange_->interlayer_drag_x : exchange_->interlayer_drag_z;
    for_each_column("fluid: interlayer drag", rows,
                    InterlayerDrag{.grid = grid_,
                                   .rows = rows.range().j1,
                                   .interlayer_drag = interlayer_drag,
                                   .alpha = step.fluid.alpha_f,
                                   .u = along_x ? step.fluid.u.x : step.fluid.u.z,
                                   .density = density_,
                                   .along_x = along_x,
                                   .u_star = along_x ? step.u_star.x : step.u_star.z,
                                   .pivot = step.spare});
  }
}

}  // namespace barchan
