#include "src/coupling/state_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "kernels/coupling/state_checks.hpp"
#include "src/base/errors.hpp"
#include "src/config/derived.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

using WorstOf = Kokkos::MaxLoc<Real, int>;

WorstItem nothing() { return {0, -1}; }

struct WorstGrains {
  WorstItem pair = nothing(), in_wall = nothing(), displacement = nothing();
};

/// Of this rank's grains. Frozen grains may lie as they like.
WorstGrains worst_of(const GrainState& grains, const CoupledStep& step, Real dt) {
  WorstGrains worst;
  Kokkos::parallel_reduce("state checks: pairs", items(grains.list.n_pairs),
                          PairOverlap{.box = step.neighbor_list().box(),
                                      .list = grains.list,
                                      .grains = grains.kin,
                                      .n_owned = grains.n},
                          WorstOf(worst.pair));
  Kokkos::parallel_reduce("state checks: grains", items(grains.n),
                          GrainLimits{.grains = grains.kin, .walls = step.walls(), .dt = dt},
                          WorstOf(worst.in_wall), WorstOf(worst.displacement));
  return worst;
}

template <class Functor>
WorstItem worst_cell(const Grid& grid, const Functor& functor) {
  WorstItem worst = nothing();
  Kokkos::parallel_reduce("state checks: worst cell", items(grid.nx * grid.ny * grid.nz),
                          WorstCell<Functor>{functor, grid.nx, grid.ny}, WorstOf(worst));
  return worst;
}

/// The message of the rank that has the worst value, on all ranks.
std::string of_the_worst(MPI_Comm ranks, Real mine, const std::string& message) {
  if (rank_count(ranks) == 1) return message;
  struct {
    double value;
    int rank;
  } worst{mine, rank_of(ranks)};
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ranks);
  auto length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, worst.rank, ranks);
  std::string worst_message = message;
  worst_message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(worst_message.data(), length, MPI_CHAR, worst.rank, ranks);
  return worst_message;
}

template <class View>
auto element(const View& view, int at) {
  typename View::non_const_value_type value;
  Kokkos::deep_copy(value, Kokkos::subview(view, at));
  return value;
}

std::string position(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x, x.y, x.z);
}

std::string grain_at(const GrainState& grains, int g) {
  return fmt::format("grain {} at {}", element(grains.id, g), position(element(grains.kin, g).x));
}

std::string cell_at(const Grid& grid, int cell) {
  const int i = cell % grid.nx, j = cell / grid.nx % grid.ny, k = cell / (grid.nx * grid.ny);
  const Vec3 x{grid.x_centre(i), element(grid.y_centre_, j + 1), grid.z_centre(k)};
  return fmt::format("cell ({}, {}, {}) at {}", grid.i_begin + i, j, grid.k_begin + k, position(x));
}

const char* name_of(const Plane& wall) {
  if (wall.normal.y != 0) return wall.normal.y > 0 ? "the floor" : "the top";
  return wall.normal.x != 0 ? "a wall across x" : "a wall across z";
}

/// The wall that a grain is deepest in.
const Plane& deepest_wall(const WallPlanes& walls, const Vec3& x) {
  int deepest = 0;
  for (int w = 1; w < walls.n; ++w) {
    if (walls[w].distance(x) < walls[deepest].distance(x)) deepest = w;
  }
  return walls[deepest];
}

/// Reported values of what is not finite.
bool is_finite(const FluidStepReport& r) {
  return std::isfinite(r.courant) && std::isfinite(r.continuity_residual);
}

constexpr const char* apart = ": move them apart, or allow it with grains.max_overlap";
constexpr const char* softer =
    ": they meet too hard or lie too deep for their stiffness: take a larger grains.youngs_modulus "
    "(and with it a shorter time.grain_step), or allow it with grains.max_overlap";

}  // namespace

std::string StateChecks::grain_problem(const GrainState& grains, const CoupledStep& step,
                                       const std::vector<Real>& worst, bool at_start) const {
  const Real limit = config_.grains->max_overlap;
  const WorstGrains mine = worst_of(grains, step, true_grain_step(config_.time));
  // A rank without grains or pairs has Kokkos' identity for a worst item: it is nowhere.
  const auto tell = [&](const WorstItem& item, auto message) {
    return of_the_worst(ranks_, item.val, item.val > 0 ? message(item.loc) : std::string());
  };
  if (!(worst[2] < kMaxDisplacement)) {
    return tell(mine.displacement, [&](int g) {
      const GrainKinematics k = element(grains.kin, g);
      const std::string who = grain_at(grains, g);
      if (!std::isfinite(k.x.x + k.x.y + k.x.z + norm(k.u) + norm(k.omega))) {
        return fmt::format("{}: its position or velocity is not finite{}", who,
                           at_start ? ""
                                    : "; time.grain_step may be too long, or grains "
                                      "overlapped at the start");
      }
      return fmt::format(
          "{} goes {:.2g} of its radius in a grain step (at {:.3g} m/s, spin {:.3g} 1/s; at most "
          "{}): contacts cannot be followed; take a shorter time.grain_step",
          who, mine.displacement.val, norm(k.u), norm(k.omega), kMaxDisplacement);
    });
  }
  if (worst[1] > limit) {
    return tell(mine.in_wall, [&](int g) {
      const Vec3 x = element(grains.kin, g).x;
      const Plane& wall = deepest_wall(step.walls(), x);
      if (wall.distance(x) < 0) {
        return fmt::format("{} has gone through {}{}", grain_at(grains, g), name_of(wall),
                           at_start ? ""
                                    : ": it was too fast or pressed too hard; take a "
                                      "shorter time.grain_step or a larger "
                                      "grains.youngs_modulus");
      }
      return fmt::format("{} is pressed {:.1f} % of its diameter into {} (at most {:.0f} %){}",
                         grain_at(grains, g), 100 * mine.in_wall.val, name_of(wall), 100 * limit,
                         at_start ? apart : softer);
    });
  }
  return tell(mine.pair, [&](int p) {
    const auto second = element(grains.id, element(grains.list.j, p));
    return fmt::format(
        "{} and grain {} overlap by {:.1f} % of their mean diameter (at most {:.0f} %){}",
        grain_at(grains, element(grains.list.i, p)), second, 100 * mine.pair.val, 100 * limit,
        at_start ? apart : softer);
  });
}

std::string StateChecks::flow_problem(const FluidState& fluid, const FluidStepReport& report,
                                      Real fraction_outside, bool at_start) const {
  const Grid& grid = fluid.grid;
  const auto where = [&](const auto& functor) {
    const WorstItem worst = worst_cell(grid, functor);
    return of_the_worst(ranks_, worst.val, worst.loc < 0 ? "no cell" : cell_at(grid, worst.loc));
  };
  const CourantOfCell courant{.grid = grid, .u = fluid.u, .dt = config_.time.fluid_step};
  if (fraction_outside > kFractionSlack) {
    const FractionOutside outside{fluid.alpha_f};
    return fmt::format(
        "alpha_f is outside 0 to 1, by {:.3g}, in {}: more grains than the cell holds{}; take "
        "wider cells (fluid.cells, at least 1.2 grain diameters) or a longer "
        "coupling.smoothing_length",
        fraction_outside > 1 ? fraction_outside - 1 : fraction_outside, where(outside),
        at_start ? "" : " have come together");
  }
  if (!is_finite(report)) {
    return fmt::format(
        "the flow is no longer finite in {}: time.fluid_step is too long for the speeds or the "
        "drag there; take a shorter one",
        where(courant));
  }
  if (report.courant > kMostCourant) {
    return fmt::format(
        "CFL = {:.2f} in {} is beyond stability: the flow is faster there than time.fluid_step "
        "allows; take one below {:.2e} s, or wider cells",
        report.courant, where(courant), config_.time.fluid_step * 0.5 / report.courant);
  }
  return fmt::format(
      "the pressure equation was left at a residual of {:.2g} of its right-hand side after {} "
      "iterations (solver.pressure_tolerance = {:.2g}; the flow is fastest in {}): allow more "
      "solver.max_iterations, take solver.preconditioner = \"local_fft\", or a larger tolerance",
      report.pressure_residual, report.pressure_iterations, config_.solver.pressure_tolerance,
      where(courant));
}

std::string StateChecks::problem_of(const SystemState& state, const CoupledStep& step,
                                    bool at_start) const {
  const bool grains_move = state.grains && !config_.grains->frozen;
  const Real limit = config_.grains ? config_.grains->max_overlap : 0;
  std::vector<Real> worst(4, 0.0);  // overlap of a pair, with a wall; displacement; fluid fraction
  if (grains_move) {
    const WorstGrains mine = worst_of(*state.grains, step, true_grain_step(config_.time));
    worst = {mine.pair.val, mine.in_wall.val, mine.displacement.val, 0};
  }
  if (state.fluid && state.grains) {
    worst[3] = max_each_cell_here("state checks: fluid fraction", state.fluid->grid,
                                  FractionOutside{state.fluid->alpha_f});
  }
  all_reduce(ranks_, std::span(worst), MPI_MAX);
  if (!(worst[0] <= limit && worst[1] <= limit && worst[2] < kMaxDisplacement)) {
    return grain_problem(*state.grains, step, worst, at_start);
  }
  if (!state.fluid) return {};
  const FluidStepReport& report = step.fluid_report();
  const bool solved = report.pressure_residual <= config_.solver.pressure_tolerance;
  if (worst[3] > kFractionSlack || !is_finite(report) || report.courant > kMostCourant || !solved) {
    return flow_problem(*state.fluid, report, worst[3], at_start);
  }
  return {};
}

void StateChecks::check(const SystemState& state, const CoupledStep& step) const {
  const std::string problem = problem_of(state, step, false);
  if (!problem.empty()) throw StateError(problem, true);
}

void StateChecks::check_start(const SystemState& state, const CoupledStep& step,
                              const std::string& source) const {
  const std::string problem = problem_of(state, step, true);
  if (!problem.empty()) throw InputError(source + ": " + problem);
}

}  // namespace barchan
