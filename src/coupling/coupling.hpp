// Fluid and grains exchange volume and momentum once per fluid step.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "kernels/coupling/deposit.hpp"
#include "kernels/coupling/gather.hpp"
#include "src/config/config.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

using DragModel = std::variant<Gidaspow, DiFelice, KochHill, SyamlalOBrien, Beetstra, PaperRepaired,
                               GidaspowBlended, NoDrag>;

/// Momentum and volume that changed sides in one fluid step, for the ledger.
struct ExchangeLedger {
  Real grain_volume = 0, deposited_volume = 0;  // [m^3], before and after the smoothing
  Vec3 given_to_grains;                         // drag and added mass over the sub-steps [N s]
  Vec3 taken_from_fluid;                        // its deposit on the faces [N s]
  Vec3 flow_on_solid;   // pressure gradient and stress: what the solid fraction takes [N s]
  Vec3 flow_on_grains;  // the same on the grains [N s]
};

/// Adds up what changed sides over a run and keeps the largest mismatch of any step.
class Ledger {
 public:
  Ledger() { add({}); }
  /// After each coupled step. Throws std::runtime_error if a grain is unaccounted for.
  void close_step(const ExchangeLedger& step, const GrainState& grains);
  /// Names and values for run.json; momentum along x, y, z [N s], mismatches relative.
  const std::map<std::string, double>& entries() const { return entries_; }

 private:
  void add(const ExchangeLedger& step);

  std::map<std::string, double> entries_;
};

/// The cells that grains up to a radius of r_max [m] deposit their volume in. Where the grid is
/// cut, points of a grain may lie in ghosts; throws ConfigError if it could reach beyond.
DepositStencil make_deposit_stencil(const Config& config, const Grid& grid, Real r_max);

/// Unresolved coupling, model A: gather before the sub-steps, deposit after them. Where the grid
/// is cut, `grains` are those whose centres lie in this rank's pencil
/// (FluidSideGrains), and all ranks call every member together.
class Coupling {
 public:
  Coupling(const Config& config, const FluidSolver& solver, const GrainState& grains,
           const Grid& grid);

  /// Velocity, share of fluid, drag coefficient and steady forces of the fluid at each grain.
  void gather(const FluidState& fluid, GrainState& grains, Real dt);
  /// alpha_f from the grains' volume, and their exchange on the faces; the old alpha_f is kept in
  /// alpha_f_previous.
  void deposit(const GrainState& grains, FluidState& fluid, Real dt);
  /// alpha_f and alpha_f_previous of grains that have just been placed.
  void start(const GrainState& grains, FluidState& fluid);

  const ExchangeOnFaces& on_faces() const { return on_faces_; }
  const ExchangeLedger& ledger() const { return ledger_; }

 private:
  CellRange cells_around(const GrainExtent& grains) const;
  void pressure_at(const FluidState& fluid, const GrainState& grains, const CellRange& around,
                   Real dt);
  void stress_at(const FluidState& fluid, const GrainState& grains, const CellRange& cells,
                 Real dt);
  void gather_density(const GrainState& grains, const CellRange& cells, const Field& alpha,
                      FaceVector& on_cells, bool smoothed, Real dt, const Kokkos::View<Vec3*>& at);
  void flow_at(const FluidState& fluid, const GrainState& grains, Real dt);
  void unsmooth(const FluidState& fluid);
  WallFaces wall_faces(bool wall, bool along_x) const;
  void reserve_flow_at(int n);
  void gather_shear(const FluidState& fluid, GrainState& grains) const;
  /// The fraction before the smoothing.
  Field local_fraction(const FluidState& fluid) const {
    return config_.smoothing_length > 0 ? unsmoothed_ : fluid.alpha_f;
  }
  /// The void fraction (quantity 0), the impulse (3 to 5).
  bool smooths(int quantity) const {
    return config_.smoothing_length > 0 &&
           (quantity == 0 || config_.exchange == Exchange::smoothed);
  }
  void add_up_grains(const GrainState& grains, const FluidState& fluid, Real dt);
  void decode(int quantity, const FixedPoint& point, Field& density) const;
  void update_fraction(FluidState& fluid);
  void spread_exchange();
  void sum_faces();
  ExchangeOfGrain of_grain(const GrainState& grains, Real dt) const;
  ExchangeByRow rows(const FluidState& fluid) const;

  CouplingConfig config_;
  FluidForces forces_;
  DragModel drag_;
  Grid grid_;
  HostGrid rows_;
  Boundary boundary_;
  Mirrors walls_;  // of the grains, where the smoothing ends
  PoissonFft smoother_;
  PeriodicBox box_;
  DepositStencil stencil_;
  bool by_row_ = false;  // the exchange
  bool first_ = false;   // step of grains that have just been placed
  Halo halo_;
  Real rho_f_ = 0, nu_ = 0;
  bool floor_ = false;  // no slip at y = 0
  SubmergedWeight weight_;
  FaceVector force_, convective_;  // room of the flow solver
  FlowAtGrains flow_at_;
  FaceVector cells_;  // densities of force or impulse; room of the flow solver
  Field unsmoothed_;  // fraction; empty without smoothing
  Deposits deposits_;
  ExchangeOnFaces on_faces_;
  GrainExtent extent_;  // of all grains, at the last deposit: they have not moved since
  ExchangeLedger ledger_;
};

}  // namespace barchan
