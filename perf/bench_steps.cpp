// Whole steps: grains alone, flow alone, both coupled. Rates are grain-steps/s and cell-steps/s.
#include <benchmark/benchmark.h>

#include <cmath>

#include "src/coupled_step.hpp"
#include "src/initial_state.hpp"

namespace barchan {
namespace {

/// Grains of Table II, in proportion, on the lattice that heaps settle from.
void add_grains(Config& c, std::int64_t n) {
  c.grains.emplace();
  c.grains->wall = c.grains->material;
  const auto part = [n](std::int64_t of_100k) { return of_100k * n / 100000; };
  c.grains->sizes = {{1.5e-4, part(2276)},
                     {1.75e-4, part(13592)},
                     {2e-4, part(68267)},
                     {2.25e-4, part(13591)},
                     {2.5e-4, part(2274)}};
  c.initial.pour.emplace();
  c.initial.pour->radius = 0.013 * std::cbrt(static_cast<double>(n) / 100000);
  c.initial.pour->centre = {0.05, 0.05};
}

/// Mesh 1 of the paper.
void add_flow(Config& c) {
  c.fluid.emplace();
  c.fluid->cells = {250, 30, 63};
  c.fluid->first_cell_height = 2.625e-4;
  c.fluid->mean_velocity = 0.28;
  c.initial.fluid = "turbulent";
}

Config paper_channel() {
  Config c;
  c.size = {0.4, 0.025, 0.1};
  return c;
}

void run_steps(benchmark::State& run, const Config& config) {
  SystemState state = make_initial_state(config, {});
  CoupledStep step(config, state);
  step.start(state);
  // The lattice collapses for a while; times are those of a heap with contacts.
  const int n_warm_up = state.grains && !state.fluid ? 200 : 3;
  for (int n = 0; n < n_warm_up; ++n) step.advance(state);
  std::int64_t iterations = 0;
  for (auto _ : run) {
    step.advance(state);
    iterations += step.fluid_report().pressure_iterations;
  }
  using benchmark::Counter;
  const auto steps = static_cast<double>(run.iterations());
  if (state.grains) {
    run.counters["grain_steps/s"] =
        Counter(steps * state.grains->n * step.substeps(), Counter::kIsRate);
    run.counters["pairs/grain"] = static_cast<double>(state.grains->list.n_pairs) / state.grains->n;
  }
  if (state.fluid) {
    const Grid& g = state.fluid->grid;
    run.counters["cell_steps/s"] = Counter(steps * g.nx * g.ny * g.nz, Counter::kIsRate);
    run.counters["pressure_iterations"] = static_cast<double>(iterations) / steps;
  }
}

void dem_heap(benchmark::State& run) {
  Config c = paper_channel();
  add_grains(c, run.range(0));
  c.grains->ambient.emplace();
  run_steps(run, c);
}
BENCHMARK(dem_heap)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

void les_mesh1(benchmark::State& run) {
  Config c = paper_channel();
  add_flow(c);
  run_steps(run, c);
}
BENCHMARK(les_mesh1)->Unit(benchmark::kMillisecond)->UseRealTime();

void coupled_mesh1(benchmark::State& run) {
  Config c = paper_channel();
  add_flow(c);
  add_grains(c, run.range(0));
  run_steps(run, c);
}
BENCHMARK(coupled_mesh1)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace barchan
