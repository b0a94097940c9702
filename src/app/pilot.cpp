#include "src/app/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "src/base/errors.hpp"
#include "src/coupling/state_checks.hpp"
#include "src/fluid/domain.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/communicator.hpp"
#include "src/run/results_writer.hpp"

namespace barchan {

namespace {

constexpr double kMaxCells = 1e6, kMaxGrains = 3e5;

/// Part of the case that has the same cells and grains: all of it, or a slice across x.
struct Slice {
  Config config;
  InitialGrains grains;
  // cells and grains of the case for each in the slice
  double cells_per_cell = 1, grains_per_grain = 1;
};

/// Adds grain g of another list, at rest and at x.
void add_at_rest(InitialGrains& to, const InitialGrains& from, std::size_t g, const Vec3& x) {
  to.add(from.id[g], from.diameter[g], x);
  if (!from.kind.empty()) to.kind.push_back(from.kind[g]);
  if (!from.q.empty()) to.q.push_back(from.q[g]);
}

/// First `grains` in order of x, as many as are timed, moved to x = 0.
InitialGrains first_grains(const InitialGrains& grains, double length) {
  std::vector<std::size_t> order(grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t g) { return grains.x[g].x; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(kMaxGrains)));
  InitialGrains first;
  const double start = grains.x[order.front()].x;
  for (const std::size_t g : order) {
    const Vec3 x = grains.x[g] - Vec3{start, 0, 0};
    if (x.x <= length) add_at_rest(first, grains, g, x);
  }
  return first;
}

Slice slice_of(const Config& config, const InitialGrains& grains) {
  Slice slice{.config = config, .grains = grains};
  if (config.fluid) {
    const auto& [nx, ny, nz] = config.fluid->cells;
    const int parts = std::clamp(
        static_cast<int>(std::ceil(static_cast<double>(nx) * ny * nz / kMaxCells)), 1, nx / 8 + 1);
    slice.config.fluid->cells[0] = nx / parts;
    slice.config.size[0] *= (nx / parts) / static_cast<double>(nx);
    slice.cells_per_cell = static_cast<double>(nx) / (nx / parts);
  }
  const auto n = static_cast<double>(grains.size());
  if (slice.cells_per_cell > 1 || n > kMaxGrains) {
    if (n > 0) slice.grains = first_grains(grains, slice.config.size[0]);
    slice.grains_per_grain = n / std::max<double>(1, static_cast<double>(slice.grains.size()));
  }
  return slice;
}

/// Makes the grains so heavy that nothing moves them: while they are timed, they touch as in the
/// heap.
void hold_grains(GrainConfig& grains) {
  grains.feed.reset();
  grains.density *= 1e9;
  for (KindConfig& kind : grains.kinds) kind.density *= 1e9;
  grains.gravity = {};
  grains.max_overlap = 1;
}

/// Grains inside the domain. Those outside, which a start in another domain may have, lie in no
/// cell.
InitialGrains inside(const InitialGrains& grains, const std::array<double, 3>& size) {
  InitialGrains kept;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3& x = grains.x[g];
    const bool in = x.x >= 0 && x.x <= size[0] && x.z >= 0 && x.z <= size[2] && x.y <= size[1];
    if (in) add_at_rest(kept, grains, g, x);
  }
  return kept;
}

RunState start(const SettledCase& the_case, const InitialGrains& grains) {
  const Config& config = the_case.config;
  const MPI_Comm ranks = MPI_COMM_WORLD;
  auto pencils = make_decomposition(config.fluid, ranks);
  SystemState state;
  if (config.fluid) {
    state.fluid = make_fluid_state(make_grid(the_case.fluid(), pencils.get()));
    set_flow(UniformFlow{}, the_case, *state.fluid);
  }
  if (config.grains)
    state.grains =
        make_grain_state(spheres_at_start(grains, config), densities_of(*config.grains), ranks);
  return {the_case, std::move(pencils), std::move(state)};
}

template <class Work>
double seconds_of(const Work& work) {
  const auto start = WallClock::now();
  work();
  Kokkos::fence("end of a part that is timed");
  return seconds_since(start);
}

/// Lower quartile: other programs only ever make a part take longer.
double lower_quartile(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Steps of a short run, each part of them timed.
class Pilot {
 public:
  explicit Pilot(const Slice& slice)
      : slice_(slice),
        run_(start(slice.config, slice.grains)),
        diagnostics_(run_),
        checks_(run_.the_case.coupled, run_.ranks),
        moves_(slice.config.grains && !slice.config.grains->frozen) {}

  PartSeconds time(double budget) {
    const auto start = WallClock::now();
    one_step();  // brings memory and plans into being
    once_in_a_while();
    for (auto* seconds : {&flow_, &pressure_, &iterations_, &exchange_, &grains_, &checks_took_})
      seconds->clear();
    const auto go_on = [&] {
      return flow_.size() < 3 || (seconds_since(start) < budget && flow_.size() < 300);
    };
    try {
      while (broadcast(go_on(), run_.ranks)) one_step();
    } catch (const StateError&) {  // a flow that is unstable soon; what was timed is as good
    }
    return parts();
  }

 private:
  void one_step() {
    CoupledStep& step = run_.coupled_step;
    SystemState& state = run_.state;
    const double gather = seconds_of([&] { step.gather(state); });
    if (moves_) grains_.push_back(seconds_of([&] { step.move_grains(state, n_); }) / n_);
    exchange_.push_back(gather + seconds_of([&] { step.deposit(state); }));
    flow_.push_back(seconds_of([&] { step.advance_fluid(state); }));
    pressure_.push_back(step.fluid_report().seconds_pressure);
    iterations_.push_back(step.fluid_report().pressure_iterations);
    step.close_step(state);
    checks_took_.push_back(seconds_of([&] { check(); }));
    // Number of grain steps that take about 20 ms, but not too few: the first looks for contacts
    // anew.
    constexpr int least = 16;
    if (moves_)
      n_ = std::min(std::max(least, static_cast<int>(0.02 / grains_.back())), step.substeps());
  }

  /// Times the checks of a run; their findings about this one do not matter.
  void check() {
    try {
      checks_.check(run_.state, run_.coupled_step);
    } catch (const StateError&) {
    }
  }

  /// Times the parts that do not act in every step, in a state that is still sound: a flow that is
  /// unstable in these steps takes its grains with it, and then there is no neighbour list.
  void once_in_a_while() {
    PartSeconds& p = parts_;
    if (moves_) {
      auto& list = *run_.coupled_step.neighbor_list();
      const auto rebuild = [&] { list.rebuild(*run_.state.grains, false); };
      const double first = seconds_of(rebuild);
      p.rebuild = slice_.grains_per_grain * std::min(first, seconds_of(rebuild));
    }
    if (run_.state.grains)
      p.dunes = slice_.grains_per_grain * seconds_of([&] { diagnostics_.find_dunes(); });
    if (run_.config.statistics)
      p.sample = slice_.cells_per_cell * seconds_of([&] { diagnostics_.sample(); });
  }

  PartSeconds parts() {
    PartSeconds p = parts_;
    p.pressure = slice_.cells_per_cell * lower_quartile(pressure_);
    p.flow = slice_.cells_per_cell * lower_quartile(flow_) - p.pressure;
    p.iterations = lower_quartile(iterations_);
    p.exchange =
        std::max(slice_.cells_per_cell, slice_.grains_per_grain) * lower_quartile(exchange_);
    p.grain_step = slice_.grains_per_grain * lower_quartile(grains_);
    p.state_checks = lower_quartile(checks_took_);
    return p;
  }

  const Slice& slice_;
  RunState run_;
  RunDiagnostics diagnostics_;
  StateChecks checks_;
  bool moves_;
  int n_ = 1;  // grain steps at a time
  PartSeconds parts_;
  std::vector<double> flow_, pressure_, iterations_, exchange_, grains_, checks_took_;
};

}  // namespace

PartSeconds time_parts(const Config& config, const InitialGrains& grains, double budget) {
  Slice slice = slice_of(config, inside(grains, config.size));
  if (slice.config.grains) hold_grains(*slice.config.grains);
  return Pilot(slice).time(budget);
}

}  // namespace barchan
