#include "src/coupling/resolved_flow.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "kernels/coupling/sphere_in_fluid.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Grains of all ranks in the order of their places, the same on all.
std::vector<FrozenGrain> grains_of_all_ranks(const GrainState& grains) {
  constexpr std::size_t width = 4;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(rank_count(grains.ranks)), 0);
  const auto here = static_cast<std::size_t>(rank_of(grains.ranks));
  counts[here] = grains.n;
  sum_over(grains.ranks, counts);
  std::size_t first = 0, all = 0;
  for (std::size_t rank = 0; rank < counts.size(); ++rank) {
    if (rank == here) first = all;
    all += static_cast<std::size_t>(counts[rank]);
  }
  std::vector<Real> numbers(width * all, 0);
  const auto kin = host_copy(grains.kin);
  for (std::size_t g = 0; g < static_cast<std::size_t>(grains.n); ++g) {
    const auto& [x, y, z] = kin(g).x;
    const Real of_grain[] = {x, y, z, kin(g).r};
    std::ranges::copy(of_grain, numbers.begin() + static_cast<std::ptrdiff_t>(width * (first + g)));
  }
  all_reduce(grains.ranks, std::span<Real>(numbers), MPI_SUM);
  std::vector<FrozenGrain> found;
  for (const Real* n = numbers.data(); n != numbers.data() + numbers.size(); n += width)
    found.push_back({.x = {n[0], n[1], n[2]}, .r = n[3]});
  std::ranges::sort(found, {}, [](const FrozenGrain& g) {
    return std::array{g.x.x, g.x.y, g.x.z};
  });
  return found;
}

/// Takes the load of the fluid on each grain, and its weight.
struct TakeLoads {
  Kokkos::View<const int*> load_of;
  Kokkos::View<const Vec3*> force, torque;  // loads of all grains
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  ExchangeOnGrains exchange;
  Kokkos::View<Vec3*> explicit_force;
  KOKKOS_FUNCTION void operator()(int g) const {
    exchange.resolved_force(g) = force(load_of(g));
    exchange.resolved_torque(g) = torque(load_of(g));
    explicit_force(g) = exchange.resolved_force(g) + weight(grains(g));
  }
};

}  // namespace

ResolvedFlow::ResolvedFlow(const CoupledCase& config, FluidSolver& solver, const Grid& grid)
    : solver_(solver),
      grid_(grid),
      bodies_(config.fluid->bodies),
      gravity_{config.grains->grains.gravity[0], config.grains->grains.gravity[1],
               config.grains->grains.gravity[2]},
      density_(config.fluid->fluid.density) {}

void ResolvedFlow::start(const GrainState& grains, FluidState& fluid) {
  Kokkos::deep_copy(fluid.alpha_f.storage, Real(1));
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, Real(1));
  place(grains);
}

/// Places the grains; a run that goes on has them only now.
void ResolvedFlow::gather(const FluidState&, GrainState& grains, Real) {
  if (!placed_) place(grains);
}

void ResolvedFlow::place(const GrainState& grains) {
  placed_ = true;
  const HostGrid rows = grid_.on_host();
  Real widest = std::max(grid_.dx, grid_.dz);
  for (int j = 0; j < rows.ny; ++j) widest = std::max(widest, rows.dy(j));
  // The search for faces asks for twice the width of a cell, and compares with twice that.
  frozen_ = FrozenGrains(grains_of_all_ranks(grains), grid_.lx, grid_.lz, 4 * widest);
  solver_.set_solids(Solids(bodies_, frozen_));
  const auto n = static_cast<std::size_t>(frozen_.count());
  force_ = Kokkos::View<Vec3*>("resolved: force", n);
  torque_ = Kokkos::View<Vec3*>("resolved: torque", n);
  force_on_host_ = mirror(force_), torque_on_host_ = mirror(torque_);
}

/// Finds the index of each grain of this rank among the frozen grains; it does not change.
void ResolvedFlow::find_loads_of(const GrainState& grains) {
  const auto kin = host_copy(grains.kin);
  std::vector<int> load_of;
  for (int g = 0; g < grains.n; ++g) load_of.push_back(frozen_.nearest(kin(g).x).body);
  load_of_ = to_device("resolved: loads", load_of);
}

void ResolvedFlow::close(GrainState& grains, Real dt) {
  if (load_of_.size() == 0) find_loads_of(grains);
  const std::vector<BodyLoad>& loads = solver_.body_loads();
  Vec3 sum;
  for (std::size_t n = 0; n < force_.extent(0); ++n) {
    const BodyLoad& load = loads[static_cast<std::size_t>(bodies_.n) + n];
    force_on_host_(n) = load.force, torque_on_host_(n) = load.torque;
    sum += load.force;
  }
  Kokkos::deep_copy(force_, force_on_host_);
  Kokkos::deep_copy(torque_, torque_on_host_);
  Kokkos::parallel_for("resolved: loads", items(grains.n),
                       TakeLoads{.load_of = load_of_,
                                 .force = force_,
                                 .torque = torque_,
                                 .weight = {.gravity = gravity_, .displaced = density_},
                                 .grains = grains.kin,
                                 .exchange = grains.exchange,
                                 .explicit_force = grains.fluid.explicit_force});
  ledger_.flow_on_solid = ledger_.flow_on_grains = dt * sum;
}

}  // namespace barchan
