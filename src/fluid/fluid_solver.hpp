// The fluid step: volume-averaged Navier-Stokes equations, Set II (model A).
#pragma once

#include <memory>
#include <vector>

#include "kernels/fluid/pressure.hpp"
#include "src/fluid/bodies_in_flow.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/drive.hpp"
#include "src/fluid/flow_measures.hpp"
#include "src/fluid/grains_in_flow.hpp"
#include "src/fluid/pressure_solver.hpp"

namespace barchan {

struct FluidStepReport {
  int pressure_iterations = 0;
  Real pressure_residual = 0;  // relative to the right-hand side
  // max |div(alpha u) + d(alpha)/dt| dt [-]; at least the share of the domain's volume that grains
  // gave back by leaving: a periodic box of incompressible fluid has nowhere to take it from.
  Real continuity_residual = 0;
  Real courant = 0;           // max dt (|u|/dx + |v|/dy + |w|/dz) [-]
  Vec2 wanted;                // bulk velocity wanted of the step [m/s]
  Vec2 drive;                 // body force per unit mass [m/s^2]
  Vec2 bulk_velocity;         // sum(alpha u V) / sum(alpha V) after the step [m/s]
  Real seconds_pressure = 0;  // wall time in the pressure equation
};

/// Makes all ghosts of a state valid.
void fill_ghosts(const Boundary& boundary, FluidState& fluid);

/// Solves, with alpha the fluid fraction and u the interstitial velocity,
///   d(alpha u)/dt + div(alpha u u) = -(alpha/rho) grad p + alpha div(2 (nu + nu_t) S)
///                                    + alpha f + exchange / rho,
///   d(alpha)/dt + div(alpha u) = 0.
/// Adams-Bashforth for convection and stress (MomentumTerms); grains and bodies are FlowTerms,
/// whose drag and walls are implicit. One pressure correction projects exactly, up to the tolerance
/// of the pressure equation. Where the fluid is clear, outside the regions of all terms, the
/// fraction is one and not read.
class FluidSolver {
 public:
  /// The fluid fraction varies in a case with grains.
  FluidSolver(const FluidCase& config, const Grid& grid);
  /// The fluid fraction varies where the state of the flow, or the exchange, says so.
  FluidSolver(const FluidCase& config, const Grid& grid, Fraction fraction);
  FluidSolver(FluidSolver&&) = default;

  const Drive& drive() const { return drive_; }
  /// Advances by dt. A fraction that varies is fluid.alpha_f, and alpha_f_previous before the last
  /// deposit, in the owned cells. `exchange`: with grains; null: none. Ghosts are valid on return.
  FluidStepReport advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt);

  /// Stops the flow inside bodies, and keeps the bulk velocity. Does nothing where nothing flows
  /// there. Ghosts of the velocity are valid on return.
  void flow_around_bodies(FluidState& fluid);
  /// Makes the flow go round these, which hold the bodies of the case. The solver must be of a
  /// variable fraction, and has no exchange from now on.
  void set_solids(const Solids& solids);
  /// Adds a term, which may use so many numbers from kOfTerms on. The solver has no bodies.
  void add_term(std::shared_ptr<FlowTerm> term, std::size_t numbers);
  /// Loads of the last step on the bodies of the case, in their order, then on the frozen grains.
  const std::vector<BodyLoad>& body_loads() const;
  /// Bodies of the flow; null without.
  const BodiesInFlow* bodies() const { return bodies_.get(); }

  /// Makes all ghosts valid, to be called after a state was set or read.
  void fill_ghosts(FluidState& fluid) const { barchan::fill_ghosts(boundary_, fluid); }

  /// Takes the divergence of alpha u away by a gradient, as the correction of a step does, with the
  /// fluid fraction held. Pressure and history stay. Ghosts of the velocity are valid on return.
  void remove_divergence(FluidState& fluid);

  Real friction_velocity(const FluidState& fluid) const {
    return barchan::friction_velocity(fluid, config_, drive_.along_z());
  }
  Real kinetic_energy(const FluidState& fluid) const {
    return barchan::kinetic_energy(fluid, config_.density);
  }

  /// Memory that others may use between two steps.
  const Workspace& workspace() const { return workspace_; }
  /// Cells around obstructed faces that the regions of a term must hold.
  int pressure_reach() const { return pressure_->reach(); }

  const Boundary& boundary() const { return boundary_; }
  const std::shared_ptr<const PlaneFft>& fft() const { return fft_; }

 private:
  void add_bodies(const Solids& solids);
  void list_terms();
  void begin(FluidState& fluid, const ExchangeOnFaces* exchange);
  FlowStep step(FluidState& fluid, Real dt);
  void update_eddy_viscosity(FluidState& fluid) const;
  void update_mass_flux(const FluidState& fluid);
  void update_mobility(const FluidState& fluid);
  template <Fraction fraction, bool with_exchange>
  Predict<fraction, with_exchange> prediction(FluidState& fluid, const ExchangeOnFaces& exchange,
                                              Real dt);
  void predict(FluidState& fluid, Real dt);
  void balance_flow_rate(const FluidState& fluid);
  void apply_drive(FluidState& fluid, Real dt);
  void solve_pressure(FluidState& fluid, Real dt);
  template <Fraction fraction>
  PressureSource<fraction> pressure_source(const FaceVector& u, const FluidState& fluid,
                                           Real drive_x, Real dt);
  template <Fraction fraction>
  CorrectVelocity<fraction> correction(FluidState& fluid, Real dt);
  void correct(FluidState& fluid, Real dt);
  void measure(FluidState& fluid, Real dt);
  /// One functor in the regions of the terms, the other in clear fluid.
  template <class Near, class Clear>
  ByRegion<Near, Clear> by_region(const Near& near, const Clear& clear) const {
    return {regions_->fraction.cells.ref(), near, clear};
  }

  FluidConfig config_;
  Grid grid_;
  bool fraction_varies_;
  Drive drive_;
  Boundary boundary_;
  std::shared_ptr<const PlaneFft> fft_;
  Workspace workspace_;
  FaceVector mobility_;            // c of the pressure equation
  Field source_;                   // right-hand side of the pressure equation
  Kokkos::View<Real*> c_w_delta_;  // of WALE, by row [m]
  std::unique_ptr<PressureSolver> pressure_;
  std::shared_ptr<BodiesInFlow> bodies_;
  std::shared_ptr<GrainsInFlow> grains_;
  std::vector<std::shared_ptr<FlowTerm>> terms_, added_;
  FlowRegions everywhere_, nowhere_;
  const FlowRegions* regions_ = &nowhere_;  // of this step
  DeviceReductions numbers_;                // FlowNumber
  DrivenFlow flow_;                         // its rate is that with the drive after apply_drive()
  FluidStepReport report_;
};

}  // namespace barchan
