// The fluid step: volume-averaged Navier-Stokes equations, Set II (model A).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kernels/fluid/pressure.hpp"
#include "src/fluid/bodies_in_flow.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/drive.hpp"
#include "src/fluid/exchange_on_faces.hpp"
#include "src/fluid/flow_measures.hpp"
#include "src/fluid/fluid_state.hpp"
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
/// Adams-Bashforth for convection and stress; interlayer drag is implicit. One pressure
/// correction projects exactly, up to the tolerance of the pressure equation.
class FluidSolver {
 public:
  /// The fraction of a case with grains is variable, and so is that of one with bodies.
  FluidSolver(const FluidCase& config, const Grid& grid);
  FluidSolver(const FluidCase& config, const Grid& grid, Fraction fraction);

  const Drive& drive() const { return drive_; }
  /// One step. Of a variable fraction fluid.alpha_f holds the new one and alpha_f_previous the old
  /// one in the owned cells; a uniform one is one. `exchange`: with the grains, if there are any;
  /// the fraction is then variable. On return all ghosts are valid.
  FluidStepReport advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt);

  /// Stops what flows inside bodies, the bulk velocity kept; nothing where nothing does. Ghosts of
  /// the velocity are valid on return.
  void flow_around_bodies(FluidState& fluid);
  /// From now on the flow goes round these, too; `solids` holds the bodies of the case. The solver
  /// must be of a variable fraction, and without exchange.
  void set_solids(const Solids& solids);
  /// Of the flow on the bodies of the case, in their order, over the last step; behind them on the
  /// frozen grains.
  const std::vector<BodyLoad>& body_loads() const { return loads_; }
  /// Null without.
  const BodiesInFlow* bodies() const { return bodies_ ? &*bodies_ : nullptr; }

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

  /// What holds nothing between two calls of advance() of a solver with grains: scratch memory for
  /// the coupling and the neighbour list.
  struct Scratch {
    FaceVector faces[2];
    std::array<Field, 3> cells;  // for finite values: the solver multiplies some of them with zero
    /// Those that may be left with any bits.
    std::vector<Field> of_any_bits() const {
      const auto& [a, b] = faces;
      return {a.x, a.y, a.z, b.x, b.y, b.z};
    }
  };
  Scratch scratch() const { return {{flux_, u_star_}, pressure_.scratch_fields()}; }

  const Boundary& boundary() const { return boundary_; }
  const std::shared_ptr<const PlaneFft>& fft() const { return fft_; }

 private:
  void update_eddy_viscosity(FluidState& fluid) const;
  void update_mass_flux(const FluidState& fluid);
  void predict(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt);
  template <Fraction fraction, bool with_exchange>
  Predict<fraction, with_exchange> prediction(FluidState& fluid, const ExchangeOnFaces* exchange,
                                              Real dt);
  void interlayer_drag(const FluidState& fluid, const ExchangeOnFaces& exchange);
  void update_mobility(const FluidState& fluid, Real dt);
  void find_driven_flow(const FluidState& fluid);
  void push(FluidState& fluid, Real dt);
  void solve_pressure(FluidState& fluid, Real dt);
  void correct(FluidState& fluid, Real dt);
  template <Fraction fraction>
  PressureSource<fraction> pressure_source(const FaceVector& u, const FluidState& fluid,
                                           Real drive_x, Real dt);
  template <Fraction fraction, bool with_bodies = false>
  CorrectVelocity<fraction, with_bodies> correction(FluidState& fluid, Real dt);
  void measure(FluidState& fluid, Real dt);

  /// Sums and maxima of a step over all cells, two a slot along x and z, three that of a vector.
  enum FlowNumber : int {
    kContinuity,
    kCourant,            // with the next ones a LargestAndSums
    kNewRate,            // flow rate of the new velocity [m^2/s]
    kPredictedRate = 4,  // of u* [m^2/s]
    kMobility = 6,       // what the mobility lacks to one [m]
    kHeld = 9,           // what bodies take of kPredictedRate [m^2/s] and kMobility along x, z [m]
    kMeanOfWater = 12,   // of the pressure or its source, where there are bodies
    kLoads               // on each body
  };

  FluidConfig config_;
  Fraction fraction_;
  Drive drive_;
  Real tolerance_;  // of the pressure equation
  Grid grid_;
  bool is_clear_;  // nothing but bodies makes the fraction variable
  FlowRegions everywhere_;
  const FlowRegions* regions_ = &everywhere_;  // of this step
  Boundary boundary_;
  std::shared_ptr<const PlaneFft> fft_;
  PressureSolver pressure_;
  FaceVector u_star_, flux_, mobility_;  // predicted velocity, alpha u [m/s]; c of the pressure
  Field source_;                         // right-hand side of the pressure equation
  Kokkos::View<Real*> c_w_delta_;        // of WALE, by row [m]
  std::optional<BodiesInFlow> bodies_;
  std::vector<BodyLoad> loads_;
  DeviceReductions numbers_;
  DrivenFlow flow_;  // its rate is that with the drive after push()
  FluidStepReport report_;
};

}  // namespace barchan
