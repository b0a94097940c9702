#include "src/app/estimate.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <cmath>

#include "kernels/grains/grain_skins.hpp"
#include "src/app/machine_load.hpp"
#include "src/app/memory.hpp"
#include "src/base/report.hpp"
#include "src/grains/grain_skins.hpp"
#include "src/grains/kinds.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"

namespace barchan {

namespace {

// Ratio of times of a grain step, measured in runs of the shipped cases (docs/dev/performance.md,
// "Estimates"). A step of a moving dune is dearer than one at rest: contacts come and go, and are
// looked for more often.
constexpr double kMovingOverResting = 1.2;
// Direct solves of the pressure equation in a step where grains move.
constexpr double kIterationsOfMoving = 2.5;
// Time of a line of history.csv with run.json [s], and rate at which frames are written [byte/s].
constexpr double kSecondsPerHistoryLine = 1e-3, kBytesPerSecond = 1e8;
constexpr double kBytesOfGrain = 100, kBytesOfCell = 56;

bool moves(const Config& config) { return config.grains && !config.grains->frozen; }

double times(double interval, double duration) {
  return interval > 0 ? std::max(0.0, duration) / interval : 0;
}

double output_seconds(const Config& config, double n_grains, const PartSeconds& parts) {
  const OutputConfig& o = config.output;
  const double end = config.time.end;
  const auto often = [&](double interval) {
    return interval > 0 ? times(std::max(interval, config.time.fluid_step), end) : 0;
  };
  double bytes = n_grains * kBytesOfGrain * (often(o.grains_interval) + often(o.tracks_interval));
  if (config.fluid) {
    const auto& [nx, ny, nz] = config.fluid->cells;
    bytes += kBytesOfCell * nx * ny * nz * often(o.fields_interval);
  }
  double seconds = kSecondsPerHistoryLine * often(o.history_interval) + bytes / kBytesPerSecond +
                   parts.dunes * often(o.dune_interval);
  if (const auto& s = config.statistics) {
    seconds += parts.sample * times(std::max(s->interval, config.time.fluid_step), end - s->start);
  }
  return seconds;
}

/// Estimated speed of the fastest grains [m/s]: slower than the flow, else as they fall.
double fastest_of(const SettledCase& the_case) {
  const Config& config = the_case.config;
  if (the_case.numbers.fluid)
    return std::max(kFastestGrains * the_case.numbers.fluid->bulk_velocity, 1e-3);
  double falls = 0;
  for (const KindNumbers& kind : the_case.numbers.grains->kinds)
    falls = std::max(falls, kind.fall_velocity);
  if (falls > 0) return falls;
  const auto& g = config.grains->gravity;
  return std::sqrt(std::hypot(g[0], g[1], g[2]) * config.size[1]);
}

bool loses_no_energy(const GrainConfig& grains) {
  return std::ranges::any_of(all_kinds(grains),
                             [](const KindConfig& kind) { return kind.material.restitution == 1; });
}

/// Grains for the pilot: those that are there, or the bed that poured ones will settle to.
InitialGrains grains_for(const PlannedGrains& planned) {
  const Config& config = planned.settled.config;
  if (!config.grains) return {};
  if (planned.grains) return *planned.grains;
  const SettledCase& pours = planned.poured_in;
  InitialGrains poured = checked_grains(pours, {});  // throws as the run would
  // Grains that lose no energy do not settle.
  if (loses_no_energy(*config.grains)) return poured;
  return packed_grains(pours.heaps, pours.config.size, pours.bodies());
}

RunSeconds timed(const PlannedGrains& planned, double budget) {
  const InitialGrains grains = grains_for(planned);
  return run_seconds(planned.settled, time_parts(planned.settled.config, grains, budget));
}

/// Time in words, with two digits below ten seconds.
std::string about(double seconds) {
  return "about " + (seconds < 9.95 ? fmt::format("{:.1f} s", seconds) : format_duration(seconds));
}

std::string shares(const RunSeconds& s) {
  std::string text;
  const auto add = [&](const char* name, double seconds) {
    const double share = std::round(100 * seconds / s.all());
    if (share > 0) text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, share);
  };
  add("grains", s.grains);
  add("lists", s.lists);
  add("exchange", s.exchange);
  add("flow", s.flow);
  add("output", s.output);
  return text;
}

/// Note that the estimate is too long if other programs were busy meanwhile; else empty.
std::string note_of_others(const std::optional<ProcessorSeconds>& before) {
  const auto after = processor_seconds();
  if (!before || !after) return {};
  const double cores = cores_of_others(*before, *after);
  constexpr double quiet = 0.25;  // part of a core
  if (cores < quiet) return {};
  return fmt::format(
      "  {:<24}the machine is busy: others had {:.1f} cores meanwhile. On a quiet one it takes "
      "less\n",
      "", cores);
}

}  // namespace

double rebuild_rate(const SettledCase& the_case) {
  const GrainSkins skins(the_case.grains(), the_case.numbers.grains->d_max / 2);
  const double fastest = fastest_of(the_case);
  const double mean = fastest / 30;  // most grains of a dune hardly move
  return fastest > 0 ? 1 / skin_horizon(skins.least(), skins.largest(), fastest, mean) : 0;
}

RunSeconds run_seconds(const SettledCase& the_case, const PartSeconds& parts) {
  const Config& config = the_case.config;
  const Derived& derived = the_case.numbers;
  const auto steps = static_cast<double>(derived.fluid_steps);
  RunSeconds s;
  const bool moving_flow = moves(config) && config.fluid;
  const double iterations =
      moving_flow ? std::max(1.0, kIterationsOfMoving / std::max(1.0, parts.iterations)) : 1;
  s.flow = steps * (parts.flow + iterations * parts.pressure);
  s.exchange = steps * parts.exchange;
  if (moves(config) && derived.grains) {
    s.grains =
        steps * derived.grain_substeps * parts.grain_step * (moving_flow ? kMovingOverResting : 1) +
        steps * parts.state_checks;
    // Rebuilds in the run, at most one in a grain step.
    const double rebuilds = std::min(rebuild_rate(the_case) * config.time.end + fed_grains(config),
                                     steps * derived.grain_substeps);
    s.lists = rebuilds * parts.rebuild;
  }
  double n_grains = derived.grains ? static_cast<double>(derived.grains->count) : 0;
  if (n_grains > 0) {  // on average half of the fed grains are there
    const double more = 1 + fed_grains(config) / 2 / n_grains;
    n_grains *= more;
    for (double* part : {&s.exchange, &s.grains, &s.lists}) *part *= more;
  }
  s.output = output_seconds(config, n_grains, parts);
  return s;
}

std::string estimate(const Case& the_case, const std::filesystem::path& folder,
                     const PlannedGrains& planned) {
  const Config& config = the_case.config;
  const auto missing = missing_starts(the_case, folder);
  const double budget = 1.5 / (2 + static_cast<double>(missing.size()));
  const auto load_before = processor_seconds();
  const RunSeconds here = timed(planned, 2 * budget);
  const int threads = Kokkos::DefaultExecutionSpace().concurrency();
  std::string text = fmt::format("  {:<24}{} on {} thread{}, timed just now ({})\n", "wall time",
                                 about(here.all()), threads, threads == 1 ? "" : "s", shares(here));
  for (const StartCase& start : missing) {
    const RunSeconds before = timed(planned_grains(start.realised, start.folder), budget);
    text += fmt::format("  {:<24}{} before that: {} has no results yet\n", "", about(before.all()),
                        start.folder.filename().string());
  }
  text += note_of_others(load_before);
  const RestartConfig& restart = config.restart;
  constexpr double long_run = 3600;
  if (here.all() > long_run && restart.interval == 0 && restart.wall_interval == 0)
    text +=
        "\nwarning: [restart] interval and wall_interval are 0: a crash would lose the whole run\n";
  return text;
}

}  // namespace barchan
