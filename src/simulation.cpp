#include "src/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/communicator.hpp"
#include "src/config_resolved.hpp"
#include "src/derived.hpp"
#include "src/domain.hpp"
#include "src/grain_state_file.hpp"
#include "src/records.hpp"
#include "src/run_identity.hpp"
#include "src/state_file.hpp"
#include "src/stop_request.hpp"
#include "src/watchdog.hpp"

namespace barchan {

namespace {

/// The state a run starts from; a restart brings its own number of grains.
SystemState first_state(const Config& config, const RunOptions& options, const InitialFiles& files,
                        MPI_Comm ranks, const Decomposition* pencils) {
  if (!options.restart) return make_initial_state(config, files, ranks, pencils);
  const CheckpointReader file(*options.restart);
  SystemState state;
  if (config.fluid) state.fluid = make_fluid_state(make_grid(config, pencils));
  if (config.grains) state.grains = grains_in_file(file, ranks);
  return state;
}

std::optional<double> time_of(const std::optional<std::filesystem::path>& restart) {
  if (!restart) return {};
  return CheckpointReader(*restart).real("t");
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
    : config_(config),
      pencils_(make_decomposition(config, ranks_)),
      provenance_(make_provenance(config)),
      state_(first_state(config, options, files, ranks_, pencils_.get())),
      coupled_step_(config, state_),
      restart_time_(time_of(options.restart)),
      folder_(options.folder, restart_time_, ranks_),
      output_(options.folder, provenance_, restart_time_, ranks_),
      tracker_(dune_domain(config)) {
  if (rank_of(ranks_) == 0) report::log_to(folder_.file("log.txt"), restart_time_.has_value());
  folder_.write_config(provenance_.config);
  end_step_ = fluid_steps(config.time);
  if (config.statistics) {
    statistics_.emplace(*config.fluid, state_.fluid->grid);
    if (config.statistics->fields) flow_average_.emplace(state_.fluid->grid);
    if (config.statistics->grain_forces) force_map_.emplace(dune_domain(config));
  }
  if (options.restart) {
    const CheckpointReader file(*options.restart, ranks_);
    load_state(file, state_, coupled_step_);
    step_ = file.integer("step");
    tracker_.set_state(file.array<double>("dunes"));
    load_statistics(file);
    report::info("going on from {} at t = {:.4f} s", options.restart->string(), time());
  } else {
    coupled_step_.start(state_);
  }
  count_grains();
  start_step_ = step_;
  start_time_ = time();
}

void Simulation::begin() {
  catch_stop_signals();
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
  } catch (const std::exception& problem) {
    progress_.finish();
    write_summary("failed", problem.what());
    throw;
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
  if (!state_.fluid) return;
  const FluidStepReport& r = coupled_step_.fluid_report();
  if (!std::isfinite(r.courant) || !std::isfinite(r.continuity_residual)) {
    throw std::runtime_error(fmt::format(
        "the flow is no longer finite at t = {:.5f} s (step {}): try a shorter time.fluid_step",
        time(), step_));
  }
  if (r.courant > 1) {
    throw std::runtime_error(fmt::format(
        "CFL = {:.2f} at t = {:.5f} s is beyond stability: take a time.fluid_step below {:.2e} s",
        r.courant, time(), config_.time.fluid_step * 0.5 / r.courant));
  }
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
  const auto every = std::max<std::int64_t>(1, std::llround(interval / config_.time.fluid_step));
  return step_ % every == 0;
}

/// Clocks and signals, which may differ between ranks.
void Simulation::agree() {
  const double limit = config_.time.wall_clock_limit, wall = config_.restart.wall_interval;
  out_of_time_ = limit > 0 && as_rank_0_says(seconds_since(wall_start_) > limit, ranks_);
  restart_wanted_ = wall > 0 && as_rank_0_says(seconds_since(last_restart_at_) > wall, ranks_);
  stop_requested_ = on_any_rank(stop_signal() != 0, ranks_);
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
    output_.write_tracks(*state_.grains, time(), step_);
  }
  if (state_.fluid && o.fields_interval > 0 && (first || due(o.fields_interval))) {
    output_.write_fields(*state_.fluid, time(), step_);
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
