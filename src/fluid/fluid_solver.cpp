#include "src/fluid/fluid_solver.hpp"

#include <utility>

#include "kernels/fluid/field_algebra.hpp"
#include "kernels/fluid/wale.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/poison.hpp"

namespace barchan {

void fill_ghosts(const Boundary& boundary, FluidState& fluid) {
  for_each_fluid_field(fluid, [&](auto& member, const FluidField& field) {
    if (field.ghosts != Ghosts::none) boundary.fill(member, field.ghosts);
  });
}

FluidSolver::FluidSolver(const FluidCase& config, const Grid& grid)
    : FluidSolver(config, grid, config.with_grains ? Fraction::variable : Fraction::uniform) {}

FluidSolver::FluidSolver(const FluidCase& config, const Grid& grid, Fraction fraction)
    : config_(config.fluid),
      grid_(grid),
      fraction_varies_(is_variable(fraction) || config.bodies.n > 0),
      drive_(config_, config.schedule),
      boundary_(grid, config_.bottom, config_.top, config_.top_velocity),
      fft_(std::make_shared<const PlaneFft>(grid)),
      workspace_(grid, fraction_varies_),
      mobility_(fraction_varies_ ? make_faces("fluid: mobility", grid) : FaceVector{}),
      source_("fluid: pressure source", grid),
      c_w_delta_("fluid: filter width", grid.ny),
      pressure_(make_pressure_solver({.grid = grid_,
                                      .halo = boundary_.halo(),
                                      .fft = fft_,
                                      .config = config.solver,
                                      .workspace = workspace_})),
      everywhere_(grid),
      nowhere_(grid),
      numbers_("fluid: numbers", kOfTerms) {
  nowhere_.exchange.set({}), nowhere_.fraction.set({});
  if (is_variable(fraction)) grains_ = std::make_shared<GrainsInFlow>(grid, config_.density);
  if (config.bodies.n > 0) add_bodies(Solids(config.bodies));
  list_terms();
  Kokkos::parallel_for("fluid: filter width", grid.ny,
                       FilterWidth{grid, config_.wale_constant, c_w_delta_});
}

void FluidSolver::add_bodies(const Solids& solids) {
  bodies_ =
      std::make_shared<BodiesInFlow>(solids, grid_, boundary_.halo(), config_, pressure_->reach());
  numbers_ = DeviceReductions("fluid: numbers", kOfTerms + bodies_->numbers());
}

void FluidSolver::set_solids(const Solids& solids) {
  grains_.reset();
  add_bodies(solids);
  list_terms();
}

void FluidSolver::add_term(std::shared_ptr<FlowTerm> term, std::size_t numbers) {
  added_.push_back(std::move(term));
  numbers_ = DeviceReductions("fluid: numbers", kOfTerms + numbers);
  list_terms();
}

/// Regions of grains hold those of bodies, and come later.
void FluidSolver::list_terms() {
  terms_.clear();
  if (bodies_) terms_.push_back(bodies_);
  if (grains_) terms_.push_back(grains_);
  terms_.insert(terms_.end(), added_.begin(), added_.end());
}

const std::vector<BodyLoad>& FluidSolver::body_loads() const {
  static const std::vector<BodyLoad> none;
  return bodies_ ? bodies_->loads() : none;
}

FlowStep FluidSolver::step(FluidState& fluid, Real dt) {
  return {.fluid = fluid,
          .u_star = workspace_.u_star,
          .mobility = mobility_,
          .spare = source_,
          .numbers = numbers_,
          .dt = dt};
}

FluidStepReport FluidSolver::advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  begin(fluid, exchange);
  update_eddy_viscosity(fluid);  // nu_t
  predict(fluid, dt);            // u*, c
  apply_drive(fluid, dt);        // f that gives the wanted bulk velocity
  solve_pressure(fluid, dt);     // p
  correct(fluid, dt);            // u, du/dt
  measure(fluid, dt);
  fluid.has_history = true;
  fluid.dt_previous = dt;
  fluid.time += dt;
  drive_.check(fluid.time, report_.wanted, report_.bulk_velocity);
  return report_;
}

/// Regions of the terms, and the fraction with ghosts.
void FluidSolver::begin(FluidState& fluid, const ExchangeOnFaces* exchange) {
  report_ = {};
  poison(workspace_.u_star);
  poison(workspace_.flux);
  poison(mobility_.x, mobility_.z, source_);  // mobility_.y is zero on the walls, once and for all
  if (grains_) grains_->set(exchange);
  regions_ = &nowhere_;
  for (const auto& term : terms_) {
    if (term->regions() != nullptr) regions_ = term->regions();
    term->correct_fraction(fluid);
  }
  if (fraction_varies_) boundary_.fill_scalars(fluid.alpha_f, fluid.alpha_f_previous);
  if (fluid.time != 0) return;
  fluid.bulk_at_start = {bulk_velocity(fluid), drive_.along_z() ? bulk_velocity_across(fluid) : 0};
}

void FluidSolver::remove_divergence(FluidState& fluid) {
  regions_ = fraction_varies_ ? &everywhere_ : &nowhere_;
  FluidState work = make_fluid_state(grid_);  // its pressure is not that of the flow
  work.u = fluid.u;
  work.alpha_f = work.alpha_f_previous = fluid.alpha_f;
  fill_ghosts(work);
  const FaceVector& u_star = workspace_.u_star;
  Kokkos::deep_copy(u_star.x.storage, fluid.u.x.storage);
  Kokkos::deep_copy(u_star.y.storage, fluid.u.y.storage);
  Kokkos::deep_copy(u_star.z.storage, fluid.u.z.storage);
  update_mobility(work);
  if (grains_) grains_->set(nullptr);
  for (const auto& term : terms_) term->after_predict(step(work, 0));
  if (fraction_varies_) boundary_.fill_periodic(mobility_);
  solve_pressure(work, 1);
  correct(work, 1);
}

void FluidSolver::flow_around_bodies(FluidState& fluid) {
  const auto bulk = [&] { return Vec2{bulk_velocity(fluid), bulk_velocity_across(fluid)}; };
  const Vec2 before = bulk();
  bool stopped = false;
  for (const auto& term : terms_) stopped = term->stop(fluid.u) || stopped;
  if (!stopped) return;
  remove_divergence(fluid);
  const Vec2 now = bulk();
  const Real wanted = before.x * before.x + before.z * before.z;
  const Real there = before.x * now.x + before.z * now.z;
  if (wanted == 0 || there == 0) return;
  const Real scale = wanted / there;
  for (Field* f : {&fluid.u.x, &fluid.u.y, &fluid.u.z})
    for_each_cell("fluid: bulk velocity", grid_, Axpby{scale, *f, 0, *f});
  boundary_.fill_velocity(fluid.u);
}

void FluidSolver::update_eddy_viscosity(FluidState& fluid) const {
  if (config_.turbulence == Turbulence::none) return;
  for_each_cell("fluid: eddy viscosity", grid_,
                UpdateEddyViscosity{grid_, fluid.u, fluid.nu_t, c_w_delta_.data()});
  for (const auto& term : terms_) term->limit_eddies(fluid.nu_t);
  boundary_.fill(fluid.nu_t, FieldKind::eddy_viscosity);
}

}  // namespace barchan
