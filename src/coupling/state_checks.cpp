#include "src/coupling/state_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "kernels/diagnostics/state_checks.hpp"
#include "src/base/errors.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

using WorstOf = Kokkos::MaxLoc<Real, int>;

template <class Functor>
WorstItem worst_cell(const Grid& grid, const Functor& functor) {
  WorstItem worst{0, -1};
  Kokkos::parallel_reduce("state checks: worst cell", items(grid.nx * grid.ny * grid.nz),
                          WorstCell<Functor>{functor, grid.nx, grid.ny}, WorstOf(worst));
  return worst;
}

/// Message of the rank that has the worst value, on all ranks.
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
  return fmt::format("grain {} at {}", grain_number(grains, element(grains.id, g)),
                     position(element(grains.kin, g).x));
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

/// Wall or body that a grain is deepest in, and the distance of its centre from that surface [m].
struct DeepestIn {
  std::string name;
  Real distance;
};

/// Finds the wall or body that x is deepest in; bodies have these names.
DeepestIn find_deepest(const GrainSolver& solver, const std::vector<std::string>& bodies,
                       const Vec3& x) {
  const WallShapes& walls = solver.walls();
  DeepestIn deepest{"nothing", std::numeric_limits<Real>::infinity()};
  const auto look_at = [&](Real distance, const auto& name) {
    if (distance < deepest.distance) deepest = {name(), distance};
  };
  for (int w = 0; w < walls.n; ++w) {
    const Plane wall = walls.at(w, x);
    look_at(wall.distance(x), [&] { return std::string(name_of(wall)); });
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    look_at(solver.bodies().body[b].distance(x),
            [&] { return fmt::format("body \"{}\"", bodies[b]); });
  return deepest;
}

/// Messages about the worst grain or pair of this rank.
struct GrainProblems {
  const GrainState& grains;
  const GrainSolver& solver;
  const std::vector<std::string>& bodies;
  Real limit;  // grains.max_overlap
  bool at_start;

  std::string displacement(const WorstItem& worst) const {
    const GrainKinematics k = element(grains.kin, worst.loc);
    const std::string who = grain_at(grains, worst.loc);
    if (!std::isfinite(k.x.x + k.x.y + k.x.z + norm(k.u) + norm(k.omega))) {
      return who + ": its position or velocity is not finite" +
             (at_start ? ""
                       : "; time.grain_step may be too long, or grains overlapped at the start");
    }
    return fmt::format(
        "{} goes {:.2g} of its radius in a grain step (at {:.3g} m/s, spin {:.3g} 1/s; at most "
        "{}): contacts cannot be followed; take a shorter time.grain_step",
        who, worst.val, norm(k.u), norm(k.omega), kMaxDisplacement);
  }
  std::string in_wall(const WorstItem& worst) const {
    const Vec3 x = element(grains.kin, worst.loc).x;
    const DeepestIn wall = find_deepest(solver, bodies, x);
    const std::string who = grain_at(grains, worst.loc);
    if (wall.distance < 0) {
      return fmt::format("{} has gone through {}{}", who, wall.name,
                         at_start ? ""
                                  : ": it was too fast or pressed too hard; take a shorter "
                                    "time.grain_step or a larger grains.youngs_modulus");
    }
    return fmt::format("{} is pressed {:.1f} % of its diameter into {} (at most {:.0f} %){}", who,
                       100 * worst.val, wall.name, 100 * limit, remedy());
  }
  std::string pair(const WorstItem& worst) const {
    const int i = element(grains.list.i, worst.loc), j = element(grains.list.j, worst.loc);
    return fmt::format(
        "{} and grain {} overlap by {:.1f} % of their mean diameter (at most {:.0f} %){}",
        grain_at(grains, i), grain_number(grains, element(grains.id, j)), 100 * worst.val,
        100 * limit, remedy());
  }
  const char* remedy() const {
    if (at_start) return ": move them apart, or allow it with grains.max_overlap";
    return ": they meet too hard or lie too deep for their stiffness: take a larger "
           "grains.youngs_modulus (and with it a shorter time.grain_step), or allow it with "
           "grains.max_overlap";
  }
};

}  // namespace

std::string StateChecks::flow_problem(const FluidState& fluid, const FluidStepReport& report,
                                      Real fraction_outside, bool at_start) const {
  const auto where = [&](const auto& functor) {
    const WorstItem worst = worst_cell(fluid.grid, functor);
    return of_the_worst(ranks_, worst.val,
                        worst.loc < 0 ? "no cell" : cell_at(fluid.grid, worst.loc));
  };
  const CourantOfCell courant{.grid = fluid.grid, .u = fluid.u, .dt = config_.time.fluid_step};
  if (fraction_outside > kFractionSlack) {
    return fmt::format(
        "alpha_f is outside 0 to 1, by {:.3g}, in {}: more grains than the cell holds{}; take "
        "wider cells (fluid.cells, at least 1.2 grain diameters) or a longer "
        "coupling.smoothing_length",
        fraction_outside > 1 ? fraction_outside - 1 : fraction_outside,
        where(FractionOutside{fluid.alpha_f}), at_start ? "" : " have come together");
  }
  if (!std::isfinite(report.courant) || !std::isfinite(report.continuity_residual)) {
    return fmt::format(
        "the flow is no longer finite in {}: time.fluid_step is too long for the speeds or the "
        "drag there; take a shorter one",
        where(courant));
  }
  if (report.courant > kMaxCourant) {
    return fmt::format(
        "CFL = {:.2f} in {} is beyond stability: the flow is faster there than time.fluid_step "
        "allows; take one below {:.2e} s, or wider cells",
        report.courant, where(courant), config_.time.fluid_step * 0.5 / report.courant);
  }
  if (report.pressure_residual <= config_.fluid->solver.pressure_tolerance) return {};
  return fmt::format(
      "the pressure equation was left at a residual of {:.2g} of its right-hand side after {} "
      "iterations (solver.pressure_tolerance = {:.2g}; the flow is fastest in {}): allow more "
      "solver.max_iterations, take solver.preconditioner = \"local_fft\", or a larger tolerance",
      report.pressure_residual, report.pressure_iterations,
      config_.fluid->solver.pressure_tolerance, where(courant));
}

StateChecks::Worst StateChecks::worst_here(const SystemState& state, const CoupledStep& step,
                                           bool grains_move) const {
  using OnDevice = Kokkos::MaxLoc<Real, int, Kokkos::DefaultExecutionSpace::memory_space>;
  if (grains_move) {
    const GrainState& grains = *state.grains;
    Kokkos::parallel_reduce("state checks: pairs", items(grains.list.n_pairs),
                            PairOverlap{.box = step.neighbor_list()->box(),
                                        .list = grains.list,
                                        .grains = grains.kin,
                                        .n_owned = grains.n},
                            OnDevice(worst_.into<WorstItem>(kPair)));
    Kokkos::parallel_reduce("state checks: grains", items(grains.n),
                            GrainLimits{.grains = grains.kin,
                                        .walls = step.grain_solver()->walls(),
                                        .bodies = step.grain_solver()->bodies(),
                                        .dt = true_grain_step(config_.time)},
                            worst_.into<WorstGrains>(kGrains));
  }
  const bool has_fraction = state.fluid && state.grains;
  if (has_fraction)
    max_each_cell("state checks: fluid fraction", worst_, kFraction, owned_cells(state.fluid->grid),
                  FractionOutside{state.fluid->alpha_f});
  worst_.fetch();
  Worst worst;
  if (grains_move) worst = {worst_.get<WorstItem>(kPair), worst_.get<WorstGrains>(kGrains), 0};
  if (has_fraction) worst.fraction = std::max<Real>(worst_.get(kFraction), 0);
  return worst;
}

std::string StateChecks::problem_of(const SystemState& state, const CoupledStep& step,
                                    bool at_start) const {
  const bool grains_move = state.grains && !config_.grains->grains.frozen;  // others may lie anyhow
  const Worst mine = worst_here(state, step, grains_move);
  std::vector<Real> worst{mine.grains.displacement.val, mine.grains.in_wall.val, mine.pair.val,
                          mine.fraction};
  all_reduce(ranks_, std::span(worst), MPI_MAX);
  if (grains_move) {
    const GrainProblems problems{*state.grains, *step.grain_solver(), config_.grains->body_names,
                                 config_.grains->grains.max_overlap, at_start};
    const auto check = [&](Real of_all, Real most, const WorstItem& item, auto problem) {
      if (of_all <= most) return std::string();
      // A rank without grains or pairs has Kokkos' identity for a worst item: it is nowhere.
      return of_the_worst(ranks_, item.val, item.val > 0 ? (problems.*problem)(item) : "");
    };
    for (const std::string& found :
         {check(worst[0], kMaxDisplacement, mine.grains.displacement, &GrainProblems::displacement),
          check(worst[1], problems.limit, mine.grains.in_wall, &GrainProblems::in_wall),
          check(worst[2], problems.limit, mine.pair, &GrainProblems::pair)}) {
      if (!found.empty()) return found;
    }
  }
  if (!state.fluid) return {};
  return flow_problem(*state.fluid, step.fluid_report(), worst[3], at_start);
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
