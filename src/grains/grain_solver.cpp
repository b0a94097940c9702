#include "src/grains/grain_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "kernels/grains/contact_parts.hpp"
#include "kernels/grains/grain_motion.hpp"
#include "kernels/grains/pair_forces.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

StiffnessLaw make_law(const GrainConfig& grains, const Material& a, const Material& b) {
  const Real damping = damping_ratio(b.restitution);
  if (grains.contact_model == ContactModel::linear) {
    return LinearSpring{.k_n = grains.linear_stiffness, .damping = damping};
  }
  const Elastic first{.youngs_modulus = a.youngs_modulus, .poisson_ratio = a.poisson_ratio};
  const Elastic second{.youngs_modulus = b.youngs_modulus, .poisson_ratio = b.poisson_ratio};
  return HertzMindlin{.e_eff = effective_youngs_modulus(first, second),
                      .g_eff = effective_shear_modulus(first, second),
                      .damping = damping};
}

RollingLaw make_rolling(const GrainConfig& grains) {
  if (grains.material.rolling_friction == 0 && grains.wall.rolling_friction == 0) {
    return NoRolling{};  // every model vanishes with mu_r
  }
  switch (grains.rolling_model) {
    case RollingModel::epsd2:
      return Epsd2{};
    case RollingModel::theta_m:
      return ThetaM{.theta_m = grains.rolling_theta_m};
    case RollingModel::cdt:
      return ConstantTorque{};
    case RollingModel::none:
      break;
  }
  return NoRolling{};
}

Friction friction_of(const Material& m, CoulombLimit limit) {
  return {.sliding = m.sliding_friction,
          .rolling = m.rolling_friction,
          .dashpot_in_limit = limit == CoulombLimit::total ? 1.0 : 0.0};
}

}  // namespace

GrainSolver::GrainSolver(const Config& config, GrainState& grains)
    : ranks_(grains.ranks),
      list_(config, grains.r_max, grains.ranks),
      pair_law_(make_law(*config.grains, config.grains->material, config.grains->material)),
      wall_law_(make_law(*config.grains, config.grains->material, config.grains->wall)),
      rolling_(make_rolling(*config.grains)),
      pair_friction_(friction_of(config.grains->material, config.grains->coulomb_limit)),
      wall_friction_(friction_of(config.grains->wall, config.grains->coulomb_limit)),
      exit_x_(config.grains->boundary_x == GrainBoundaryX::exit),
      lx_(config.size[0]) {
  const auto add_walls = [&](Vec3 normal, Real distance) {
    if (distance <= 2 * grains.r_max) {
      throw std::runtime_error("domain.size: " + std::to_string(distance) +
                               " m between two walls, less than the largest grain is wide");
    }
    plane_[n_walls_++] = {normal, 0};
    plane_[n_walls_++] = {-normal, -distance};
  };
  add_walls({0, 1, 0}, config.size[1]);
  if (config.grains->boundary_x == GrainBoundaryX::wall) add_walls({1, 0, 0}, config.size[0]);
  if (config.grains->boundary_z == GrainBoundaryZ::wall) add_walls({0, 0, 1}, config.size[2]);
  using WallHistory = decltype(grains.wall_xi_t);
  const auto n = static_cast<std::size_t>(std::max(grains.n, 1));
  const auto n_opposite = static_cast<std::size_t>(n_walls_ / 2);
  grains.wall_xi_t = WallHistory("wall xi_t", n, n_opposite);
  list_.with_rolling = !std::holds_alternative<NoRolling>(rolling_);
  if (list_.with_rolling) grains.wall_torque = WallHistory("wall torque", n, n_opposite);
  list_.with_force = config.output.grain_forces;
}

template <class Stiffness, class Rolling>
void GrainSolver::sub_step(const Stiffness& law, const Rolling& rolling, const GrainState& grains,
                           const KickAndDrift& motion, int s, bool last) {
  const PairForces<Stiffness, Rolling> pairs{
      .law = law,
      .rolling = rolling,
      .friction = pair_friction_,
      .box = list_.box(),
      .dt = motion.dt,
      .validity = {.moved = moved_, .before = place(s), .limit = list_.limit()},
      .grains = grains.kin,
      .list = grains.list,
      .keep_force = list_.with_force && last};
  const int n_blocks = (grains.list.n_crossing + kBlock - 1) / kBlock;
  Kokkos::parallel_for("grains: crossing pairs", items(n_blocks), pairs);
  SumKickDrift<Stiffness, Rolling> sum{.motion = motion,
                                       .pairs = pairs,
                                       .walls = {.n = n_walls_,
                                                 .plane = {},
                                                 .law = std::get<Stiffness>(wall_law_),
                                                 .rolling = rolling,
                                                 .friction = wall_friction_,
                                                 .xi_t = grains.wall_xi_t,
                                                 .torque = grains.wall_torque,
                                                 .touching = grains.wall_touching},
                                       .has_rolling = list_.with_rolling,
                                       .last = last,
                                       .largest_margin = list_.largest_margin()};
  for (int w = 0; w < n_walls_; ++w) sum.walls.plane[w] = plane_[w];
  Kokkos::parallel_reduce("grains: inner pairs, sum, kick and drift",
                          items(grains.list.chunks.count()), sum, max_displacement(s + 1));
}

/// Over ranks, before each sub-step: ghosts where their grains are, or a new list as soon as a
/// grain of any rank has moved too far for it.
void GrainSolver::bring_together(GrainState& grains, int s) {
  const auto at = Kokkos::subview(moved_, place(s));
  Real moved = 0;
  Kokkos::deep_copy(moved, at);
  if (max_over(ranks_, moved) <= list_.limit()) {
    list_.update_ghosts(grains);
  } else {
    list_.rebuild(grains, false);
    Kokkos::deep_copy(at, Real(0));
  }
}

template <class Stiffness, class Rolling>
void GrainSolver::sub_steps(const Stiffness& law, const Rolling& rolling, GrainState& grains, int n,
                            Real dt) {
  const auto motion = [&] {  // a rebuild may move the arrays
    return KickAndDrift{.dt = dt,
                        .grains = grains.kin,
                        .contact_force = grains.contact_force,
                        .contact_torque = grains.contact_torque,
                        .x_reference = grains.x_reference,
                        .fluid = grains.fluid};
  };
  if (moved_.extent_int(0) != ahead_ + 1) {
    moved_ = Kokkos::View<Real*>("way of the grains", static_cast<std::size_t>(ahead_) + 1);
  }
  Kokkos::deep_copy(grains.list.slack, -1.0);  // the first drift does not keep account
  Kokkos::parallel_reduce("grains: first kick and drift", items(grains.n), motion(),
                          max_displacement(0));
  if (list_.partition()) {
    for (int s = 0; s < n; ++s) {
      bring_together(grains, s);
      sub_step(law, rolling, grains, motion(), s, s + 1 == n);
    }
    return;
  }
  const auto moved = Kokkos::create_mirror_view(moved_);
  for (int s = 0; s < n;) {
    const int end = std::min(s + ahead_, n);
    for (int next = s; next < end; ++next)
      sub_step(law, rolling, grains, motion(), next, next + 1 == n);
    Kokkos::deep_copy(moved, moved_);
    const auto is_stale = [&](int step) { return !(moved(place(step)) <= list_.limit()); };
    while (s < end && !is_stale(s)) ++s;
    if (s < n && is_stale(s)) {
      list_.rebuild(grains, false);
      Kokkos::deep_copy(Kokkos::subview(moved_, place(s)), Real(0));
    }
  }
}

void GrainSolver::advance(GrainState& grains, int n, Real dt) {
  if (n == 0 || (grains.n == 0 && !list_.partition())) return;
  std::visit([&](const auto& law, const auto& rolling) { sub_steps(law, rolling, grains, n, dt); },
             pair_law_, rolling_);
}

void GrainSolver::remove_left(GrainState& grains) {
  if (!exit_x_) return;
  const auto kin = grains.kin;
  const Real lx = lx_;
  int n_outside = 0;
  Kokkos::parallel_reduce(
      "grains: count beyond the outlet", grains.n,
      KOKKOS_LAMBDA(int g, int& count) { count += kin(g).x.x >= 0 && kin(g).x.x <= lx ? 0 : 1; },
      n_outside);
  if (sum_over(ranks_, std::int64_t{n_outside}) > 0) list_.rebuild(grains, true);
}

void GrainSolver::split_contacts(const GrainState& grains, const Kokkos::View<Vec3*>& normal,
                                 const Kokkos::View<Vec3*>& tangential) const {
  if (!grains.list.has_force()) {
    throw std::logic_error("the forces of pairs were not kept: set output.grain_forces");
  }
  SplitContacts split{.box = list_.box(),
                      .list = grains.list,
                      .grains = grains.kin,
                      .contact_force = grains.contact_force,
                      .wall_touching = grains.wall_touching,
                      .plane = {},
                      .normal = normal,
                      .tangential = tangential};
  for (int w = 0; w < n_walls_; ++w) split.plane[w] = plane_[w];
  Kokkos::parallel_for("output: split contacts", grains.list.chunks.count(), split);
}

ContactSummary GrainSolver::contacts(const GrainState& grains) const {
  ContactSummary summary;
  const PairList list = grains.list;
  const auto kin = grains.kin;
  const PeriodicBox box = list_.box();
  const int n_owned = grains.n;
  Kokkos::parallel_reduce(
      "grains: contact summary", list.n_pairs,
      KOKKOS_LAMBDA(int p, std::int64_t& count, Real& overlap) {
        if (!list.touching(p) || list.i(p) >= n_owned) return;  // counted where the first one is
        ++count;
        const GrainKinematics &a = kin(list.i(p)), &b = kin(list.j(p));
        const Real relative = 1 - norm(box.nearest_image(a.x - b.x)) / (a.r + b.r);
        overlap = relative > overlap ? relative : overlap;
      },
      summary.n_contacts, Kokkos::Max<Real>(summary.max_overlap));
  if (summary.n_contacts == 0)
    summary.max_overlap = 0;  // the maximum over nothing is minus infinity
  return {.n_contacts = sum_over(ranks_, summary.n_contacts),
          .max_overlap = max_over(ranks_, summary.max_overlap)};
}

}  // namespace barchan
