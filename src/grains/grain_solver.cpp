#include "src/grains/grain_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "kernels/grains/body_contact.hpp"
#include "kernels/grains/clump_motion.hpp"
#include "kernels/grains/grain_step.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

RollingModels::Variant make_rolling(const GrainConfig& grains, const GrainKinds& kinds) {
  bool rolls = grains.wall.rolling_friction != 0;
  for (const Material& m : kinds.material) rolls = rolls || m.rolling_friction != 0;
  for (const auto& [pair, m] : kinds.unlike) rolls = rolls || m.rolling_friction != 0;
  if (!rolls) return NoRolling{};  // every model vanishes with mu_r
  return RollingModels::make(grains.rolling_model, grains.rolling_theta_m);
}

/// Largest reach of any law at that effective radius [m].
Real largest_reach(const LawTables& tables, Real r_eff) {
  Real largest = 0;
  const auto look = [&](const auto& table) {
    for (const auto& law : table.stiffness) largest = std::max(largest, reach(law, r_eff));
  };
  std::visit(look, tables);
  return largest;
}

int tiles_of(int n) { return (n + kTile - 1) / kTile; }

GrainMotion motion(const GrainState& grains, Real dt, Real elapsed) {
  return {.dt = dt,
          .elapsed = elapsed,
          .grains = grains.kin,
          .x_reference = grains.x_reference,
          .fluid = grains.fluid,
          .slack = grains.list.slack};
}

}  // namespace

void add_wall(WallShapes& walls, const Plane& plane, int history) {
  if (walls.n == kMaxWalls) throw std::length_error("more walls than kMaxWalls");
  walls.plane[walls.n] = plane;
  walls.history[walls.n++] = history;
  walls.n_histories = std::max(walls.n_histories, history + 1);
}

GrainSolver::GrainSolver(const GrainsCase& config, GrainState& grains)
    : GrainSolver(config, grains, kinds_of(config.grains)) {}

GrainSolver::GrainSolver(const GrainsCase& config, GrainState& grains, const GrainKinds& kinds)
    : ranks_(grains.ranks),
      many_kinds_(kinds.count() > 1),
      pair_laws_(laws_of_pairs(config.grains, kinds, config.film)),
      wall_laws_(laws_of_walls(config.grains, kinds, config.film)),
      list_(config, grains.r_max, grains.ranks, largest_reach(pair_laws_, grains.r_max / 2),
            longest_arm(config.grains, grains.r_max)),
      rolling_(make_rolling(config.grains, kinds)),
      on_bodies_(config, grains, !std::holds_alternative<NoRolling>(rolling_),
                 largest_reach(wall_laws_, grains.r_max)) {
  list_.with_laws = many_kinds_;
  add_walls(config, grains.r_max);
  using WallHistory = decltype(grains.wall_xi_t);
  const auto n = static_cast<std::size_t>(std::max(grains.n, 1));
  if (many_kinds_) {
    if (grains.kind.size() == 0) grains.kind = Kokkos::View<std::uint8_t*>("kind", n);
    grains.kind_names = names_of_kinds(config.grains);
  }
  const auto n_histories = static_cast<std::size_t>(walls_.n_histories);
  grains.wall_xi_t = WallHistory("wall xi_t", n, n_histories);
  list_.with_rolling = !std::holds_alternative<NoRolling>(rolling_);
  if (list_.with_rolling) grains.wall_torque = WallHistory("wall torque", n, n_histories);
  list_.with_force = config.keeps_forces;
  if (!has_clumps(config.grains)) return;
  grains.shapes = clump_shapes(config.grains);
  if (grains.clump.size() == 0) grains.clump = Kokkos::View<ClumpMotion*>("clump", n);
}

void GrainSolver::add_walls(const GrainsCase& config, Real r_max) {
  const auto add = [&](Vec3 normal, Real offset, int history) {
    add_wall(walls_, {normal, offset}, history);
  };
  const auto add_opposite = [&](Vec3 normal, Real distance) {
    if (distance <= 2 * r_max) {
      throw std::runtime_error("domain.size: " + std::to_string(distance) +
                               " m between two walls, less than the largest grain is wide");
    }
    const int history = walls_.n_histories;
    add(normal, 0, history);
    add(-normal, -distance, history);
  };
  const auto& size = config.size;
  if (config.grains.floor == GrainFloor::glued) {
    walls_.glued = glued_floor(config.grains.floor_diameter / 2, size[0], size[2]);
    // A glued floor has no fixed planes: WallShapes::at finds them for each grain.
    for (int colour = 0; colour < GluedFloor::kColours; ++colour) add({0, 1, 0}, 0, colour);
    add({0, -1, 0}, -size[1], 0);
  } else {
    add_opposite({0, 1, 0}, size[1]);
  }
  if (config.grains.boundary_x == GrainBoundaryX::wall) add_opposite({1, 0, 0}, size[0]);
  if (config.grains.boundary_z == GrainBoundaryZ::wall) add_opposite({0, 0, 1}, size[2]);
}

/// Starts the grain steps: first half kick and drift.
void GrainSolver::kick_and_drift(const GrainState& grains, int n, Real dt) {
  if (excess_.extent_int(0) <= n) {
    excess_ = Kokkos::View<Real*>("excess over the skin", static_cast<std::size_t>(n) + 1);
    host_excess_ = mirror(excess_);
    kernels_.drop_graph();
  }
  // Let every chunk find its active pairs in the first grain step.
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), grains.list.expired, 1);
  if (grains.clump.size() > 0) return move_clumps<Moves::into_first>(grains, 0, dt);
  Kokkos::parallel_reduce("grains: first kick and drift", items(tiles_of(grains.n)),
                          KickAndDrift{.motion = motion(grains, dt, 0),
                                       .n = grains.n,
                                       .contact_force = grains.contact_force,
                                       .contact_torque = grains.contact_torque},
                          max_excess(0));
}

/// Grain step s: forces at the new positions and second half kick, then, unless it is the last one,
/// the first half kick and drift of the next one.
void GrainSolver::grain_step(const GrainState& grains, int s, bool last, Real dt) {
  with_laws([&](const auto& of_pairs, const auto& of_walls) {
    std::visit(
        [&](const auto& rolling) { launch(grains, of_pairs, of_walls, rolling, s, last, dt); },
        rolling_);
  });
}

template <class Stiffness, bool many, class Rolling>
void GrainSolver::launch(const GrainState& grains, const LawTable<Stiffness, many>& of_pairs,
                         const LawTable<Stiffness, many>& of_walls, const Rolling& rolling, int s,
                         bool last, Real dt) {
  using Law = ContactLaw<Stiffness, Rolling, many>;
  const PairForces<Law> pairs{.law = {.table = of_pairs, .rolling = rolling, .dt = dt},
                              .box = list_.box(),
                              .validity = {.excess = excess_, .before = s},
                              .grains = grains.kin,
                              .list = grains.list,
                              .keep_force = list_.with_force && last};
  kernels_.for_each("grains: inter-chunk pairs", tiles_of(grains.list.n_inter), pairs);
  if (on_bodies_.any())
    kernels_.for_each("grains: bodies", on_bodies_.near().n,
                      BodyContacts<Law>{.bodies = on_bodies_.bodies(),
                                        .law = {.table = of_walls, .rolling = rolling, .dt = dt},
                                        .validity = pairs.validity,
                                        .near = on_bodies_.near(),
                                        .grains = grains.kin,
                                        .kind = grains.kind,
                                        .xi_t = grains.body_xi_t,
                                        .rolling = grains.body_torque,
                                        .touching = grains.body_touching,
                                        .sums = on_bodies_.sums()});
  const Walls<Law> walls{.shapes = walls_,
                         .law = {.table = of_walls, .rolling = rolling, .dt = dt},
                         .grains = grains.kin,
                         .xi_t = grains.wall_xi_t,
                         .torque = grains.wall_torque,
                         .touching = grains.wall_touching,
                         .kind = grains.kind};
  const SumKickDrift<Law> sum{.motion = motion(grains, dt, (s + 0.5) * dt),
                              .pairs = pairs,
                              .walls = walls,
                              .of_bodies = on_bodies_.sums(),
                              .contact_force = grains.contact_force,
                              .contact_torque = grains.contact_torque,
                              .last = last,
                              .min_slack = list_.min_slack(),
                              .of_clumps = grains.clump.size() > 0};
  kernels_.reduce("grains: intra-chunk pairs, sum, kick and drift", grains.list.chunks.count(), sum,
                  max_excess(s + 1));
  if (!sum.of_clumps) return;
  if (last) {
    move_clumps<Moves::out_of_last>(grains, s + 1, dt);
  } else {
    move_clumps<Moves::between>(grains, s + 1, dt);
  }
}

/// Moves the clumps at the end of grain step s - 1, or before the first one.
template <Moves moves>
void GrainSolver::move_clumps(const GrainState& grains, int s, Real dt) {
  const MoveClumps<moves> move{.dt = dt,
                               .elapsed = s > 0 ? (s - 0.5) * dt : 0,
                               .box = list_.box(),
                               .validity = {.excess = excess_, .before = std::max(s - 1, 0)},
                               .clumps = {grains.shapes, grains.members, grains.clump, grains.kind},
                               .grains = grains.kin,
                               .contact_force = grains.contact_force,
                               .contact_torque = grains.contact_torque,
                               .x_reference = grains.x_reference,
                               .fluid = grains.fluid,
                               .list = grains.list};
  kernels_.reduce("grains: move clumps", grains.members.n, move, max_excess(s));
}

void GrainSolver::rebuild(GrainState& grains, int s) {
  list_.rebuild(grains, false);
  Kokkos::deep_copy(Kokkos::subview(excess_, s), Real(0));
  on_bodies_.find(grains, list_.rebuilds());
}

/// Updates the ghosts before a grain step, or rebuilds the list as soon as a grain of any rank has
/// moved too far for it.
void GrainSolver::update_ghosts(GrainState& grains, int s) {
  Real excess = 0;
  Kokkos::deep_copy(excess, Kokkos::subview(excess_, s));
  if (max_over(grains.ranks, excess) <= 0) {
    list_.update_ghosts(grains);
  } else {
    rebuild(grains, s);
  }
}

/// Makes a graph of all grain steps, or keeps the last one, if the list has lived for a fluid step
/// already: it may well outlive another one, and making a graph takes as long as launching its
/// kernels.
bool GrainSolver::prepare_graph(const GrainState& grains, int n, Real dt) {
  const GraphOf now{list_.rebuilds(), n, dt};
  const bool list_lives = list_.rebuilds() == rebuilds_before_;
  rebuilds_before_ = list_.rebuilds();
  if (now != graph_of_) kernels_.drop_graph();
  if (kernels_.has_graph()) return true;
  if (!makes_graphs_ || !list_lives) return false;
  kernels_.begin_graph();
  for (int s = 0; s < n; ++s) grain_step(grains, s, s + 1 == n, dt);
  kernels_.end_graph();
  graph_of_ = now;
  return true;
}

/// Launches grain steps on one rank, from grain step s: as many as are launched ahead, or all that
/// are in the graph. Returns the first one that the list no longer covered, after a rebuild for it.
int GrainSolver::launch_ahead(GrainState& grains, int s, int n, Real dt) {
  int end = std::min(s + ahead_, n);
  if (s == 0 && prepare_graph(grains, n, dt)) {
    end = n;
    kernels_.launch_graph("grains: graph of grain steps");
  } else {
    for (int next = s; next < end; ++next) grain_step(grains, next, next + 1 == n, dt);
  }
  Kokkos::deep_copy(host_excess_, excess_);
  const auto is_stale = [&](int step) { return !(host_excess_(step) <= 0); };
  while (s < end && !is_stale(s)) ++s;
  if (s < n && is_stale(s)) rebuild(grains, s);
  return s;
}

void GrainSolver::advance(GrainState& grains, int n, Real dt) {
  if (n == 0) return;
  on_bodies_.begin(grains, n, strongest_on_body(grains.r_max));
  on_bodies_.find(grains, list_.rebuilds());
  if (grains.n == 0 && !list_.partition()) return;
  kick_and_drift(grains, n, dt);
  for (int s = 0; s < n;) {
    if (list_.partition()) {
      update_ghosts(grains, s);
      grain_step(grains, s, s + 1 == n, dt);
      ++s;
    } else {
      s = launch_ahead(grains, s, n, dt);
    }
  }
}

}  // namespace barchan
