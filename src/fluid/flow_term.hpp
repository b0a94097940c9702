// Terms of the fluid step: bodies, grains and whatever else acts on the flow.
#pragma once

#include "src/fluid/exchange_on_faces.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/parallel/device_reductions.hpp"

namespace barchan {

/// Numbers that a step adds up over all cells. A pair is along x and z; a vector takes three.
enum FlowNumber : int {
  kContinuity,
  kCourant,            // begins LargestAndSums, which goes on with the next pair
  kNewRate,            // pair: flow rate of the new velocity [m^2/s]
  kPredictedRate = 4,  // pair: flow rate of u* [m^2/s]
  kMobility = 6,       // vector of UpdateMobility: what the mobility lacks to one [m]
  kTaken = 9,         // vector: what terms take of the rate [m^2/s], of the mobility along x, z [m]
  kMeanOfFluid = 12,  // mean of the pressure or of its source
  kOfTerms            // numbers of a single term begin here
};

/// Fields and numbers of the step under way. A term may change what they refer to.
struct FlowStep {
  FluidState& fluid;
  FaceVector& u_star;    // predicted velocity [m/s]
  FaceVector& mobility;  // c of the pressure equation, near grains and bodies
  Field& spare;          // cell field with room for any values until the pressure is solved
  const DeviceReductions& numbers;
  Real dt;
};

/// A term of the step beside convection and stress, which are ExplicitTerms of the predictor. The
/// solver calls the functions of all terms in this order; a term defines those that it needs.
class FlowTerm {
 public:
  virtual ~FlowTerm() = default;

  /// Columns of cells whose fluid is not clear because of this term; null: it has none in this
  /// step.
  virtual const FlowRegions* regions() const { return nullptr; }
  /// Corrects the fluid fraction, new and old, before anything is computed with it.
  virtual void correct_fraction(FluidState&) {}
  /// Changes the eddy viscosity, without ghosts.
  virtual void limit_eddies(Field&) {}
  /// Acts implicitly on u* and the mobility. What it takes of both is added up in kTaken.
  virtual void after_predict(const FlowStep&) {}
  /// Acts on u*_z, to which the drive across has just been added.
  virtual void after_drive_across(const FlowStep&) {}
  /// Projects the source of the pressure, then the pressure, onto what this term allows.
  virtual void constrain_pressure(Field&, const DeviceReductions&) {}
  /// Follows the new velocity and pressure, or adds up numbers of them.
  virtual void after_correct(const FlowStep&) {}
  /// Reads numbers that the host has fetched.
  virtual void report(const DeviceReductions&) {}

  /// Stops the flow of a start where there can be none. Returns whether there was any, on all
  /// ranks.
  virtual bool stop(FaceVector&) { return false; }
};

}  // namespace barchan
