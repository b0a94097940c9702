// Single kernels. Those that a public call runs alone are timed as that call; the others inside the
// step they belong to, by their Kokkos label, so that they find the data and caches they find in a
// run.
#include <chrono>
#include <functional>
#include <memory>

#include "perf/bench.hpp"
#include "perf/cases.hpp"
#include "perf/events.hpp"
#include "src/fluid/poisson_fft.hpp"

namespace barchan {

namespace {

constexpr int kNSubsteps = 100;  // grain steps in the cases below

using Action = std::function<void()>;

struct Kernel {
  std::string name;
  CaseSpec spec;
  std::vector<std::string> labels;              // empty: the whole action is timed
  std::function<Action(RunningCase&)> prepare;  // makes the action that is timed
  std::string unit;                             // "grain-steps", "grains" or "cell-steps"
  std::function<Work(RunningCase&)> per_unit;
  int steps_at_once = 1;  // steps of one action
};

double wall_time(const Action& action) {
  Kokkos::fence("before a timed action");
  const auto start = std::chrono::steady_clock::now();
  action();
  Kokkos::fence("after a timed action");
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run_kernel(benchmark::State& run, const Kernel& kernel) {
  RunningCase& c = running_case(kernel.spec);
  const Action action = kernel.prepare(c);
  const std::unique_ptr<KernelClock> clock =
      kernel.labels.empty() ? nullptr : std::make_unique<KernelClock>(kernel.labels);
  while (run.KeepRunningBatch(kernel.steps_at_once)) {
    const double whole = wall_time(action);
    if (clock && !clock->missing().empty()) {
      facts().problem = "no kernel is called '" + clock->missing() + "'";
      run.SkipWithError(facts().problem.c_str());
      return;
    }
    run.SetIterationTime(clock ? clock->take() : whole);
  }
  if (c.state.grains) count_contacts(run, c);
  CaseFacts f = describe(c);
  const double units = kernel.unit == "cell-steps" ? c.cells() : c.grains();
  f.units = {{kernel.unit, units}};
  f.per_step = units * kernel.per_unit(c);
  facts() = std::move(f);
}

void add_kernel(const Kernel& kernel) {
  add_benchmark("kernel/" + kernel.name, [kernel](benchmark::State& run) {
    run_kernel(run, kernel);
  })->UseManualTime();
}

double pairs_of(const RunningCase& c) { return c.per_grain(c.state.grains->list.n_pairs); }

Action move_grains(RunningCase& c) {
  return [&c] { c.step->move_grains(c.state); };
}

Action build_list(RunningCase& c) {
  return [&c] { c.step->neighbor_list()->rebuild(*c.state.grains, true); };
}

double contacts_of(RunningCase& c) {
  return c.per_grain(c.step->grain_solver()->contacts(*c.state.grains).n_contacts);
}

Work pair_force_work(RunningCase& c) {
  return work::integrate(false) + work::pair_forces(pairs_of(c), contacts_of(c), false);
}

void register_grain_kernels() {
  const CaseSpec heap = grains_alone("dem/heap_100k", "heap_100k", 0);
  CaseSpec loose = grains_alone("dem/loose", "lattice", 0);
  loose.config.grains->gravity = {0, 0, 0};
  // The kernel that holds most pair forces holds sum and integration as well; grains that touch
  // nothing show what that part takes.
  const std::string fused = "grains: intra-chunk pairs, sum, kick and drift";
  add_kernel({.name = "pair_forces",
              .spec = heap,
              .labels = {"grains: inter-chunk pairs", fused},
              .prepare = move_grains,
              .unit = "grain-steps",
              .per_unit = pair_force_work,
              .steps_at_once = kNSubsteps});
  const auto add_list_build = [](const std::string& name, const CaseSpec& spec) {
    add_kernel(
        {.name = name,
         .spec = spec,
         .labels = {},
         .prepare = build_list,
         .unit = "grains",
         .per_unit = [](RunningCase& c) { return work::list_build(pairs_of(c), contacts_of(c)); }});
  };
  add_list_build("list_build", heap);
  add_list_build("list_build_10k", grains_alone("dem/heap_10k", "heap_10k", 0));
  add_list_build("list_build_1m", ten_heaps());
  add_kernel({.name = "integration",
              .spec = loose,
              .labels = {fused},
              .prepare = move_grains,
              .unit = "grain-steps",
              .per_unit = [](RunningCase&) { return work::integrate(false); },
              .steps_at_once = kNSubsteps});
}

Action solve_once(RunningCase& c, Real mass, Real diffusion) {
  const Grid& grid = c.state.fluid->grid;
  const auto fft = std::make_shared<const PlaneFft>(grid);
  const auto solver = std::make_shared<const PoissonFft>(grid, fft, mass, diffusion);
  Field in("bench: right-hand side", grid), out("bench: solution", grid);
  Kokkos::deep_copy(in.storage, c.state.fluid->u.x.storage);
  return [solver, in, out]() mutable { solver->solve(in, out); };
}

Work solve_work(RunningCase& c) {
  const Grid& g = c.state.fluid->grid;
  return work::poisson(g.nx, g.nz);
}

Action advance_flow(RunningCase& c) {
  return [&c] { c.step->advance_fluid(c.state); };
}

void register_flow_kernels() {
  const auto add = [](const char* name, std::vector<std::string> labels,
                      std::function<Action(RunningCase&)> prepare,
                      std::function<Work(RunningCase&)> per_unit) {
    add_kernel({.name = name,
                .spec = channel_flow("les/mesh1", 1),
                .labels = std::move(labels),
                .prepare = std::move(prepare),
                .unit = "cell-steps",
                .per_unit = std::move(per_unit)});
  };
  add("momentum", {"fluid: predict"}, advance_flow, [](RunningCase&) { return work::predict(); });
  add("wale", {"fluid: eddy viscosity"}, advance_flow, [](RunningCase&) { return work::wale(); });
  add(
      "poisson", {}, [](RunningCase& c) { return solve_once(c, 0, 1); }, solve_work);
  add(
      "smoothing", {}, [](RunningCase& c) { return solve_once(c, 1, 3.6e-7); }, solve_work);
}

Action deposit(RunningCase& c) {
  return [&c] { c.step->deposit(c.state); };
}

Action gather(RunningCase& c) {
  return [&c] { c.step->gather(c.state); };
}

void register_coupling_kernels() {
  const CaseSpec coupled = heap_in_channel("coupled/heap_100k", "heap_100k", 1);
  add_kernel({.name = "deposit",
              .spec = coupled,
              .labels = {"coupling: deposit"},
              .prepare = deposit,
              .unit = "grains",
              .per_unit = [](RunningCase&) { return work::deposit(); }});
  add_kernel({.name = "gather",
              .spec = coupled,
              .labels = {"coupling: flow at grains", "coupling: gather"},
              .prepare = gather,
              .unit = "grains",
              .per_unit = [](RunningCase&) { return work::gather(); }});
}

}  // namespace

void register_kernels() {
  register_coupling_kernels();  // first: it goes on where the last whole case stopped
  register_flow_kernels();
  register_grain_kernels();
}

}  // namespace barchan
