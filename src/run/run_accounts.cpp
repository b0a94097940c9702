#include "src/run/run_accounts.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "src/parallel/communicator.hpp"
#include "src/run/run_identity.hpp"

namespace barchan {

namespace {

double per_step(const RunState& run, double sum) {
  return sum / std::max<double>(1, static_cast<double>(run.clock.steps_done()));
}

double cell_steps(const RunState& run) {
  return static_cast<double>(run.clock.steps_done()) * static_cast<double>(run.n_cells());
}

/// Wall seconds per fluid step, by phase.
Phases phases_per_step(const RunState& run, const Phases& others) {
  Phases all;
  for (const Phases* phases : {&run.coupled_step.phases(), &others}) {
    for (const auto& [name, seconds] : *phases) all[name] = per_step(run, seconds);
  }
  return all;
}

/// Per fluid step, of this rank; the imbalance is that of all.
std::map<std::string, double> communication(const RunState& run, const MessageCounts& start) {
  const MessageCounts& now = message_counts();
  const auto since = [&](auto all, auto before, double unit = 1) {
    return per_step(run, unit * static_cast<double>(all - before));
  };
  std::map<std::string, double> c;
  c["messages"] = since(now.messages, start.messages);
  c["megabytes"] = since(now.bytes, start.bytes, 1e-6);
  c["reductions"] = since(now.reductions, start.reductions);
  c["all_to_alls"] = since(now.all_to_alls, start.all_to_alls);
  if (!run.state.grains) return c;
  const NeighborList& list = run.coupled_step.neighbor_list();
  c["grains"] = run.state.grains->n;
  c["ghost_grains"] = run.state.grains->n_ghosts;
  c["grain_imbalance"] = list.partition()->imbalance();
  c["list_rebuilds"] = per_step(run, static_cast<double>(list.rebuilds()));
  return c;
}

}  // namespace

void RunAccounts::begin() {
  wall_start_ = WallClock::now();
  messages_at_start_ = message_counts();
}

void RunAccounts::add_fluid_step(const FluidStepReport& report, double fluid_step) {
  const double residual = report.continuity_residual / fluid_step;
  ++interval_.steps;
  interval_.iterations += report.pressure_iterations;
  interval_.courant = std::max(interval_.courant, report.courant);
  interval_.continuity_residual = std::max(interval_.continuity_residual, residual);
  iterations_sum_ += report.pressure_iterations;
  iterations_max_ = std::max<std::int64_t>(iterations_max_, report.pressure_iterations);
  max_courant_ = std::max(max_courant_, report.courant);
  max_residual_ = std::max(max_residual_, residual);
}

void RunAccounts::save(CheckpointWriter& file) const {
  const std::array<double, 4> numbers{static_cast<double>(interval_.steps),
                                      static_cast<double>(interval_.iterations),
                                      interval_.continuity_residual, interval_.courant};
  file.array("since_history_row", std::span<const double>(numbers));
}

void RunAccounts::load(const CheckpointReader& file) {
  if (!file.has("since_history_row")) return;
  const auto numbers = file.array<double>("since_history_row", {4});
  interval_ = {.steps = static_cast<std::int64_t>(numbers[0]),
               .iterations = static_cast<std::int64_t>(numbers[1]),
               .continuity_residual = numbers[2],
               .courant = numbers[3]};
}

Progress RunAccounts::progress(const RunState& run) const {
  const double seconds = std::max(wall_seconds(), 1e-9);
  Progress p;
  p.t = run.clock.time();
  p.t_start = static_cast<double>(run.clock.start) * run.clock.fluid_step;
  p.t_end = run.config.time.end;
  p.grain_steps_per_second = static_cast<double>(grain_steps_) / seconds;
  if (run.state.fluid) {
    p.cell_steps_per_second = cell_steps(run) / seconds;
    p.cfl = run.coupled_step.fluid_report().courant;
    p.pressure_iterations = run.coupled_step.fluid_report().pressure_iterations;
  }
  p.n_grains = run.n_grains;
  return p;
}

nlohmann::ordered_json RunAccounts::summary(const RunState& run, const std::string& status,
                                            const std::string& message) const {
  const double wall = wall_seconds(), for_rates = std::max(wall, 1e-9);
  const int ranks = rank_count(run.ranks);
  const std::int64_t grains_at_start = run.state.grains ? run.state.grains->n_initial : 0;
  nlohmann::ordered_json json;
  json["status"] = status;
  json["message"] = message;
  json["title"] = run.provenance.title;
  json["version"] = run.provenance.version;
  json["git_hash"] = run.provenance.git_hash;
  json["backend"] = Kokkos::DefaultExecutionSpace::name();
  json["device"] = device_name();
  json["threads"] = Kokkos::DefaultExecutionSpace().concurrency();
  json["ranks"] = ranks;
  json["steps"] = run.clock.step;
  json["simulated_seconds"] = run.clock.time();
  json["wall_seconds"] = wall;
  json["phases"] = phases_per_step(run, phases_);
  json["grain_steps_per_second"] = static_cast<double>(grain_steps_) / for_rates;
  json["cell_steps_per_second"] = cell_steps(run) / for_rates;
  json["pressure_iterations_mean"] = per_step(run, static_cast<double>(iterations_sum_));
  json["pressure_iterations_max"] = iterations_max_;
  json["max_cfl"] = max_courant_;
  json["max_overlap"] = max_overlap_;
  json["max_continuity_residual"] = max_residual_;
  if (ranks > 1) json["communication"] = communication(run, messages_at_start_);
  json["ledger"] = run.coupled_step.ledger().entries();
  json["grains_initial"] = grains_at_start;
  json["grains_inside"] = run.n_grains;
  json["grains_left"] = grains_at_start - run.n_grains;
  return json;
}

}  // namespace barchan
