#include "src/run/simulation.hpp"

#include <fmt/ranges.h>

#include <cmath>

#include "src/base/errors.hpp"
#include "src/base/stop_request.hpp"
#include "src/case/derived.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace {

/// Source of a start state, for messages.
std::string source_of(const Config& config, const RunOptions& options, const InitialFiles& files) {
  if (options.restart) return options.restart->string();
  return config.grains ? source_of_grains(config, files.grains) : "initial.fluid";
}

}  // namespace

Simulation::Simulation(const SettledCase& the_case, const RunOptions& options,
                       const InitialFiles& files)
    : options_(options),
      restart_(options.restart
                   ? std::make_unique<CheckpointReader>(*options.restart, MPI_COMM_WORLD)
                   : nullptr),
      run_(the_case, restart_.get(), files),
      diagnostics_(run_),
      state_checks_(the_case.coupled, run_.ranks) {
  accounts_.bodies = BodySums(run_.config.bodies.size());
  if (restart_) {
    diagnostics_.load(*restart_);
    accounts_.load(*restart_);
    restart_.reset();
  }
  const std::string source = source_of(run_.config, options, files);
  state_checks_.check_start(run_.state, run_.coupled_step, source);
  if (!options.restart) follow_first_dune(source);
}

/// Places the edge first, if the window follows its dune. Refuses a start without a dune, or with
/// grains at the edge.
void Simulation::follow_first_dune(const std::string& source) {
  if (!run_.config.grains || run_.config.grains->boundary_x != GrainBoundaryX::follow) return;
  GrainState& grains = *run_.state.grains;
  diagnostics_.find_dunes();
  diagnostics_.place_window_edge(grains);
  const double edge = grains.window_edge, half = half_edge_strip(run_.config);
  if (!std::isfinite(edge))
    throw InputError(source + ": holds no dune that grains.boundary_x = \"follow\" could follow");
  int n_cut = 0;
  const GrainState whole = whole_grains(grains);
  Kokkos::parallel_reduce("grains: at the edge", whole.n,
                          run_.coupled_step.neighbor_list()->leaving(whole), n_cut);
  const std::int64_t n = sum_over(run_.ranks, n_cut);
  if (n == 0) return;
  throw InputError(fmt::format(
      "{}: {} grains lie within {:.4g} m of x = {:.4g} m, half a box from the largest dune, where "
      "grains leave with grains.boundary_x = \"follow\": take a longer domain.size",
      source, n, half, edge));
}

void Simulation::open_folder() {
  results_.emplace(options_.folder, run_, diagnostics_, accounts_);
  if (!run_.restart_time) return;
  report::info("going on from {} at t = {:.6g} s", options_.restart->string(), run_.clock.time());
  if (!run_.changed_config.empty())
    report::info("changed since: {}", fmt::join(run_.changed_config, ", "));
}

Outcome Simulation::run() {
  catch_stop_signals();
  if (!results_) open_folder();
  accounts_.begin();
  results_->write_summary("running", "");
  if (!run_.restart_time) results_->write_due();
  try {
    return loop();
  } catch (const StateError& problem) {
    const std::string message = results_->write_failure(problem);
    say_failed(message);
    throw std::runtime_error(message);
  } catch (const std::exception& problem) {
    say_failed(problem.what());
    throw;
  }
}

Outcome Simulation::loop() {
  std::string stopped;  // reason, if it was stopped
  while (run_.clock.step < run_.clock.end && stopped.empty()) {
    one_step();
    stopped = reason_to_stop();
    results_->write_due();
    progress_.update(accounts_.progress(run_, diagnostics_.largest_dune()));
  }
  progress_.finish();
  results_->write_restart();
  results_->write_summary(stopped.empty() ? "done" : "stopped",
                          stopped.empty() ? unfed_grains(run_) : stopped);
  if (stopped.empty()) return Outcome::done;
  report::info("{}; state in {}: go on with --resume", stopped, last_restart()->string());
  return Outcome::stopped;
}

/// Advances the state, keeps the accounts, and stops a run that has gone wrong.
void Simulation::one_step() {
  Watchdog::heartbeat("computing", run_.clock.step + 1, run_.clock.time());
  accounts_.grain_steps += run_.n_grains * run_.coupled_step.substeps();
  run_.advance();
  {
    const PhaseTimer timer(accounts_.phases, "state_checks");
    state_checks_.check(run_.state, run_.coupled_step);
  }
  accounts_.bodies.add(run_.coupled_step);
  if (!run_.state.fluid) return;
  for (FluidStepSums* sums : {&accounts_.interval, &accounts_.all})
    sums->add(run_.coupled_step.fluid_report(), run_.clock.fluid_step,
              run_.coupled_step.impulse_on_grains());
}

/// Reason to stop; empty to go on. Clocks and signals may differ between ranks; all get the same
/// answer.
std::string Simulation::reason_to_stop() const {
  const double limit = run_.config.time.wall_clock_limit;
  const bool out_of_time =
      limit > 0 && broadcast(seconds_since(accounts_.start) > limit, run_.ranks);
  const bool requested = any_rank(stop_signal != 0, run_.ranks);
  if (out_of_time) return "the wall-clock limit was reached";
  return requested ? "stopped on request" : "";
}

/// Writes the failure to run.json, if the disk, which may be the problem, lets us.
void Simulation::say_failed(const std::string& message) {
  progress_.finish();
  try {
    results_->write_summary("failed", message);
  } catch (const std::exception&) {
    report::warn("run.json could not be written: it still says \"running\"");
  }
}

std::optional<std::filesystem::path> Simulation::last_restart() const {
  if (auto written = latest_checkpoint(options_.folder)) return written;
  return options_.restart;
}

}  // namespace barchan
