#include "src/run/simulation.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/base/errors.hpp"
#include "src/base/stop_request.hpp"
#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/resolved.hpp"
#include "src/fluid/domain.hpp"
#include "src/output/grain_state_file.hpp"
#include "src/output/state_file.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/particle_exchange.hpp"
#include "src/run/run_identity.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace {

/// What the user gave is wrong, whatever the layer that met it says: exit code 2.
template <class Read>
auto read_input(const Read& read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& problem) {
    throw InputError(problem.what());
  }
}

std::unique_ptr<const CheckpointReader> open_restart(const RunOptions& options, MPI_Comm ranks) {
  if (!options.restart) return {};
  return read_input(
      [&] { return std::make_unique<const CheckpointReader>(*options.restart, ranks); });
}

/// Refuses a restart file that does not fit the case.
void check_restart(const Config& config, const CheckpointReader& file) {
  const std::string resolved = file.provenance().config;
  if (resolved.empty()) return;  // not ours: its arrays must speak for themselves
  const auto conflicts = restart_conflicts(config, config_as_written(resolved, file.path()));
  if (conflicts.empty()) return;
  throw InputError(
      fmt::format("cannot restart from {}: it does not fit this case\n  {}\nkeep these keys "
                  "as they were, or start anew",
                  file.path().string(), fmt::join(conflicts, "\n  ")));
}

/// The state a run starts from; a restart brings its own number of grains.
SystemState first_state(const Config& config, const CheckpointReader* restart,
                        const InitialFiles& files, MPI_Comm ranks, const Decomposition* pencils) {
  if (restart == nullptr) return make_initial_state(config, files, ranks, pencils);
  check_restart(config, *restart);
  SystemState state;
  if (config.fluid) state.fluid = make_fluid_state(make_grid(config, pencils));
  if (config.grains) state.grains = grains_in_file(*restart, ranks);
  return state;
}

/// Where the grains of a start come from, for messages.
std::string source_of(const Config& config, const InitialFiles& files) {
  if (!files.grains.empty()) return files.grains.string();
  return config.grains ? "initial.grains.pour" : "initial.fluid";
}

DuneDomain dune_domain(const Config& config) {
  const bool grains = config.grains.has_value();
  return {.length_x = config.size[0],
          .length_z = config.size[2],
          .periodic_x = grains && config.grains->boundary_x == GrainBoundaryX::periodic,
          .periodic_z = grains && config.grains->boundary_z == GrainBoundaryZ::periodic};
}

}  // namespace

Simulation::Simulation(const Config& config, const RunOptions& options, const InitialFiles& files)
    : Simulation(config, options, files, open_restart(options, MPI_COMM_WORLD)) {}

Simulation::Simulation(const Config& config, const RunOptions& options, const InitialFiles& files,
                       std::unique_ptr<const CheckpointReader> restart)
    : config_(config),
      options_(options),
      pencils_(make_decomposition(config, ranks_)),
      provenance_(make_provenance(config)),
      state_(read_input(
          [&] { return first_state(config, restart.get(), files, ranks_, pencils_.get()); })),
      coupled_step_(read_input([&] { return CoupledStep(config, state_); })),
      state_checks_(config, ranks_),
      tracker_(dune_domain(config)),
      end_step_(fluid_steps(config.time)) {
  if (config.statistics) {
    statistics_.emplace(*config.fluid, state_.fluid->grid);
    if (config.statistics->fields) flow_average_.emplace(state_.fluid->grid);
    if (config.statistics->grain_forces) force_map_.emplace(dune_domain(config));
  }
  read_input([&] {
    if (restart) {
      go_on_from(*restart);
    } else {
      coupled_step_.start(state_);
    }
    state_checks_.check_start(state_, coupled_step_,
                              restart ? options.restart->string() : source_of(config, files));
    return true;
  });
  count_grains();
  start_step_ = step_;
  start_time_ = time();
}

void Simulation::go_on_from(const CheckpointReader& file) {
  load_state(file, state_, coupled_step_);
  step_ = file.integer("step");
  if (step_ > end_step_) {
    throw InputError(
        fmt::format("cannot restart from {}: its time, {:.6g} s, is beyond time.end = "
                    "{:.6g} s: set a later end, or take an earlier restart file",
                    file.path().string(), file.real("t"), config_.time.end));
  }
  restart_time_ = file.real("t");
  if (std::abs(*restart_time_ - time()) > 1e-6 * config_.time.fluid_step) {
    throw InputError(fmt::format("cannot restart from {}: its time {:.6g} s is not that of step {}",
                                 file.path().string(), *restart_time_, step_));
  }
  tracker_.set_state(file.array<double>("dunes"));
  if (file.has("since_history_row")) {  // else written by an earlier version
    const auto since_row = file.array<double>("since_history_row", {4});
    interval_ = {.steps = static_cast<std::int64_t>(since_row[0]),
                 .iterations = static_cast<std::int64_t>(since_row[1]),
                 .continuity_residual = since_row[2],
                 .courant = since_row[3]};
  }
  load_statistics(file);
  const std::string resolved = file.provenance().config;
  if (!resolved.empty()) changed_ = changed_keys(config_, config_as_written(resolved, file.path()));
}

void Simulation::open_folder() {
  folder_.emplace(options_.folder, restart_time_, ranks_);
  output_.emplace(options_.folder, provenance_, restart_time_, ranks_);
  if (rank_of(ranks_) == 0) report::log_to(folder_->file("log.txt"), restart_time_.has_value());
  folder_->write_config(provenance_.config);
  if (!restart_time_) return;
  report::info("going on from {} at t = {:.4f} s", options_.restart->string(), time());
  if (!changed_.empty()) report::info("changed since: {}", fmt::join(changed_, ", "));
}

void Simulation::begin() {
  catch_stop_signals();
  if (!folder_) open_folder();
  wall_start_ = last_restart_at_ = WallClock::now();
  messages_at_start_ = message_counts();
  write_summary("running", "");
  if (!restart_time_) write_due(true);
}

Outcome Simulation::run() {
  begin();
  try {
    while (step_ < end_step_) {
      one_step();
      agree();
      write_due(false);
      show_progress();
      if (!stop_requested_ && !out_of_time_) continue;
      progress_.finish();
      write_restart();
      const std::string why =
          out_of_time_ ? "the wall-clock limit was reached" : "stopped on request";
      write_summary("stopped", why);
      report::info("{}; go on with --restart {}", why, last_restart()->string());
      return Outcome::stopped;
    }
    progress_.finish();
    write_restart();
    write_summary("done", "");
    return Outcome::done;
  } catch (const StateError& problem) {
    progress_.finish();
    const std::string message = write_failure(problem);
    say_failed(message);
    throw std::runtime_error(message);
  } catch (const std::exception& problem) {
    progress_.finish();
    say_failed(problem.what());
    throw;
  }
}

/// In run.json, if the disk that may be the problem lets us.
void Simulation::say_failed(const std::string& message) {
  try {
    write_summary("failed", message);
  } catch (const std::exception&) {
    report::warn("run.json could not be written: it still says \"running\"");
  }
}

void Simulation::one_step() {
  grain_steps_ += n_grains_ * coupled_step_.substeps();
  Watchdog::beat("computing", step_ + 1, time());
  coupled_step_.advance(state_);
  ++step_;
  count_grains();
  watch();
}

void Simulation::count_grains() {
  if (state_.grains) n_grains_ = sum_over(ranks_, state_.grains->n);
}

/// Keeps the extremes and stops a run that has gone wrong.
void Simulation::watch() {
  {
    const PhaseTimer timer(phases_, "health");
    state_checks_.check(state_, coupled_step_);
  }
  if (!state_.fluid) return;
  const FluidStepReport& r = coupled_step_.fluid_report();
  const double residual = r.continuity_residual / config_.time.fluid_step;
  ++interval_.steps;
  interval_.iterations += r.pressure_iterations;
  interval_.courant = std::max(interval_.courant, r.courant);
  interval_.continuity_residual = std::max(interval_.continuity_residual, residual);
  iterations_sum_ += r.pressure_iterations;
  iterations_max_ = std::max<std::int64_t>(iterations_max_, r.pressure_iterations);
  max_courant_ = std::max(max_courant_, r.courant);
  max_residual_ = std::max(max_residual_, residual);
}

bool Simulation::due(double interval) const {
  if (!(interval > 0)) return false;
  const double steps = std::min(interval / config_.time.fluid_step, 1e18);
  const auto every = std::max<std::int64_t>(1, std::llround(steps));
  return step_ % every == 0;
}

/// Clocks and signals, which may differ between ranks.
void Simulation::agree() {
  const double limit = config_.time.wall_clock_limit, wall = config_.restart.wall_interval;
  out_of_time_ = limit > 0 && broadcast(seconds_since(wall_start_) > limit, ranks_);
  restart_wanted_ = wall > 0 && broadcast(seconds_since(last_restart_at_) > wall, ranks_);
  stop_requested_ = any_rank(stop_signal() != 0, ranks_);
}

bool Simulation::restart_due() const { return due(config_.restart.interval) || restart_wanted_; }

void Simulation::write_due(bool first) {
  Watchdog::beat("writing results", step_, time());
  const OutputConfig& o = config_.output;
  if (state_.grains && o.dune_interval > 0 && (first || due(o.dune_interval))) {
    const PhaseTimer timer(phases_, "analytics");
    write_dunes();
  }
  sample_statistics();
  const PhaseTimer timer(phases_, "output");
  if (o.history_interval > 0 && (first || due(o.history_interval))) write_history();
  if (state_.grains && o.grains_interval > 0 && (first || due(o.grains_interval))) write_grains();
  if (state_.grains && o.tracks_interval > 0 && (first || due(o.tracks_interval))) {
    output_->write_tracks(*state_.grains, time(), step_);
  }
  if (state_.fluid && o.fields_interval > 0 && (first || due(o.fields_interval))) {
    output_->write_fields(*state_.fluid, time(), step_);
  }
  if (first) return;
  if (restart_due() && step_ < end_step_) write_restart();
  if (due(o.history_interval)) write_summary("running", "");
}

/// From statistics.start on; the results on the disk follow the restart files and the end.
void Simulation::sample_statistics() {
  if (!statistics_ || time() < config_.statistics->start) return;
  if (!due(config_.statistics->interval)) return;
  const PhaseTimer timer(phases_, "analytics");
  statistics_->sample(*state_.fluid);
  if (flow_average_) flow_average_->sample(*state_.fluid, time());
  if (force_map_) sample_forces();
}

void Simulation::show_progress() {
  if (!progress_.due()) return;
  const double seconds = std::max(seconds_since(wall_start_), 1e-9);
  const auto steps = static_cast<double>(step_ - start_step_);
  Progress p;
  p.t = time();
  p.t_start = start_time_;
  p.t_end = config_.time.end;
  p.grain_steps_per_second = static_cast<double>(grain_steps_) / seconds;
  if (state_.fluid) {
    const Grid& g = state_.fluid->grid;
    p.cell_steps_per_second = steps * g.nx_all * g.ny * g.nz_all / seconds;
    p.cfl = coupled_step_.fluid_report().courant;
    p.pressure_iterations = coupled_step_.fluid_report().pressure_iterations;
  }
  if (state_.grains) p.n_grains = n_grains_;
  if (largest_dune_) p.dune_width = largest_dune_->w, p.dune_length = largest_dune_->l;
  progress_.update(p);
}

}  // namespace barchan
