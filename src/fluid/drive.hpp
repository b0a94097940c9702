// Drive of the flow: the bulk velocity that it is to have, and the body force that gives it.
#pragma once

#include <vector>

#include "kernels/math/vec3.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// The flow of a step before the drive acts. Sums over x-faces and z-faces.
struct DrivenFlow {
  Vec2 rate;      // of alpha u* dy [m^2/s]
  Vec2 response;  // rate per force and time: of c dy, c the mobility [m]
  Real height;    // of alpha dy, over cells [m]
};

/// A force per mass along x and z, the same everywhere. The flow then has the wanted bulk velocity
/// sum(alpha u V)/sum(alpha V) before the projection.
class Drive {
 public:
  /// Takes what a case gives: bulk velocities (flow_schedule.hpp), a pressure gradient along x, or
  /// nothing.
  Drive(const FluidConfig& config, std::vector<FlowTarget> schedule);

  /// True if the drive ever acts along z. If not, nothing is computed for it.
  bool along_z() const { return along_z_; }
  /// The bulk velocity wanted at t [m/s], of a flow that began with `at_start`.
  Vec2 target(Real t, const Vec2& at_start) const;
  /// The force per mass over a step of dt [m/s^2].
  Vec2 force(const FluidState& fluid, const DrivenFlow& flow, Real dt) const;
  /// Throws StateError, on all ranks, if for some steps now no force has brought the flow nearer to
  /// the bulk velocity that is wanted of it.
  void check(Real t, const Vec2& wanted, const Vec2& bulk);

 private:
  Real gradient_x_ = 0;  // the force of a given gradient [m/s^2]
  std::vector<FlowTarget> schedule_;
  bool along_z_ = false;
  Real small_ = 0;   // difference that does not count [m/s]
  Real missed_ = 0;  // share of the wanted velocity that the last step lacked
  int in_vain_ = 0;  // steps in a row
};

}  // namespace barchan
