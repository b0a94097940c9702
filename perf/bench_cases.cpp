// Whole steps: grains alone as the peers run them, flow alone, both coupled.
#include "perf/bench.hpp"
#include "perf/cases.hpp"
#include "perf/events.hpp"
#include "perf/options.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

CaseFacts describe(const RunningCase& c) {
  CaseFacts f;
  if (c.state.grains) {
    f.sizes["grains"] = c.grains();
    f.sizes["substeps"] = c.step->substeps();
    f.notes["grains"] = c.grains_source;
  }
  if (c.state.fluid) {
    const Grid& g = c.state.fluid->grid;
    f.sizes["cells"] = {g.nx, g.ny, g.nz};
  }
  return f;
}

void count_contacts(benchmark::State& run, RunningCase& c) {
  run.counters["contacts"] =
      static_cast<double>(c.step->grain_solver()->contacts(*c.state.grains).n_contacts);
  run.counters["pairs"] = c.state.grains->list.n_pairs;
}

namespace {

/// Computed work of one grain step of all grains.
Work grain_step_work(const RunningCase& c, const benchmark::State& run) {
  const bool rolling = c.spec.config.grains->material.rolling_friction > 0;
  const double n = c.grains();
  const double pairs = run.counters.at("pairs") / n, contacts = run.counters.at("contacts") / n;
  return n * (work::integrate(c.state.grains->fluid.has_fluid) +
              work::pair_forces(pairs, contacts, rolling));
}

/// Work and units of one timed step: a grain step of grains alone, otherwise a fluid step.
void add_work(CaseFacts& f, const RunningCase& c, const benchmark::State& run) {
  const double n = c.grains(), cells = c.cells();
  if (!c.state.fluid) {
    f.units = {{"grain-steps", n}};
    f.per_step = grain_step_work(c, run);
    return;
  }
  const Grid& g = c.state.fluid->grid;
  f.units = {{"cell-steps", cells}};
  f.per_step = cells * work::flow_step(g.nx, g.nz);
  if (!c.state.grains) return;
  const double n_sub = c.step->substeps();
  f.units.emplace_back("grain-steps", n * n_sub);
  f.per_step = cells * work::coupled_step(g.nx, g.nz, run.counters.at("pressure_iterations")) +
               n_sub * grain_step_work(c, run) + n * (work::gather() + 2 * work::deposit());
}

/// Counters of the timed steps: events are per timed step, those of rebuilds per rebuild.
void count_events(benchmark::State& run, CaseFacts& f, const EventCounts& events, double rebuilds) {
  const auto steps = static_cast<double>(run.iterations());
  run.counters["allocations_per_step"] = static_cast<double>(events.allocations) / steps;
  run.counters["host_copies_per_step"] = static_cast<double>(events.host_copies) / steps;
  run.counters["deep_copies_per_step"] = static_cast<double>(events.deep_copies) / steps;
  if (rebuilds > 0) {
    run.counters["allocations_per_rebuild"] =
        static_cast<double>(events.allocations_in_rebuild) / rebuilds;
  }
  if (!events.allocated.empty()) f.notes["allocated"] = events.allocated;
  if (!events.copied.empty()) f.notes["copied"] = events.copied;
}

void run_case(benchmark::State& run, const CaseSpec& spec) {
  RunningCase& c = running_case(spec);
  const auto rebuilds_so_far = [&c]() -> std::int64_t {
    return c.state.grains ? c.step->neighbor_list()->rebuilds() : 0;
  };
  // Step of a case without flow: one grain step, the peers' unit.
  const int steps_at_once = c.state.fluid ? 1 : c.step->substeps();
  const std::int64_t rebuilds_before = rebuilds_so_far();
  double iterations = 0;
  CaseFacts f = describe(c);
  const EventCounter events;
  while (run.KeepRunningBatch(steps_at_once)) {
    c.advance();
    Kokkos::fence("end of a timed step");
    iterations += c.step->fluid_report().pressure_iterations;
  }
  const EventCounts& counted = events.counts();
  double rebuilds = 0;
  if (c.state.grains) {
    rebuilds = static_cast<double>(rebuilds_so_far() - rebuilds_before);
    run.counters["rebuilds_per_step"] = rebuilds / static_cast<double>(run.iterations());
    count_contacts(run, c);
  }
  if (c.state.fluid) {
    run.counters["pressure_iterations"] = iterations / static_cast<double>(run.iterations());
  }
  run.counters["array_bytes"] = static_cast<double>(c.bytes());
  count_events(run, f, counted, rebuilds);
  add_work(f, c, run);
  facts() = std::move(f);
}

void add_case(const CaseSpec& spec) {
  add_benchmark(spec.name, [spec](benchmark::State& run) { run_case(run, spec); })->UseRealTime();
}

/// The last state of a run in the folder of --runs.
std::optional<std::filesystem::path> state_of(const std::string& run) {
  return latest_checkpoint(options().runs / run);
}

/// Registers moving dunes, where someone has computed them.
void register_dunes() {
  if (const auto dune = state_of("dune-10k")) add_case(moving_dune("coupled/dune_10k", *dune));
  if (const auto dune = state_of("dune-100k")) {
    add_case(moving_grains("dem/dune_100k", *dune));
    add_case(moving_dune("coupled/dune_100k", *dune));
  }
}

}  // namespace

void register_cases() {
  // This case comes first: the spare rows that grains leave behind would count as its own.
  add_case(channel_flow("les/mesh1", 1));
  add_case(channel_flow("les/mesh2", 2));
  add_case(channel_flow("les/mesh3", 3));
  add_case(grains_alone("dem/heap_10k", "heap_10k", 0));
  add_case(grains_alone("dem/heap_100k_epsd2", "heap_100k", 0.1));
  CaseSpec flowing = grains_alone("dem/heap_100k_rebuild_100", "heap_100k", 0);
  flowing.rebuild_each_step = true;
  add_case(flowing);
  add_case(ten_heaps());
  add_case(grains_alone("dem/heap_100k", "heap_100k", 0));
  add_case(shipped_10k("coupled/barchan_10k"));
  add_case(heap_in_channel("coupled/heap_10k", "heap_10k", 1));
  add_case(heap_in_channel("coupled/heap_10k_mesh3", "heap_10k", 3));
  add_case(heap_in_channel("coupled/heap_100k", "heap_100k", 1));
  register_dunes();
}

}  // namespace barchan
