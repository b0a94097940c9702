#include "src/run/run_accounts.hpp"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "src/case/derived.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

namespace {

double per_step(const RunState& run, double sum) {
  return sum / std::max<double>(1, static_cast<double>(run.clock.steps_done()));
}

double rebuilds_per_step(const RunState& run) {
  return per_step(run, static_cast<double>(run.coupled_step.neighbor_list()->rebuilds()));
}

/// Cells of all ranks, each as often as it was computed.
double cell_steps(const RunState& run) {
  if (!run.state.fluid) return 0;
  const Grid& g = run.state.fluid->grid;
  const std::int64_t cells = std::int64_t{1} * g.nx_all * g.ny * g.nz_all;
  return static_cast<double>(run.clock.steps_done()) * static_cast<double>(cells);
}

/// Wall seconds per fluid step, by phase.
Phases phases_per_step(const RunState& run, const Phases& others) {
  Phases all;
  for (const Phases* phases : {&run.coupled_step.phases(), &others}) {
    for (const auto& [name, seconds] : *phases) all[name] = per_step(run, seconds);
  }
  return all;
}

/// Communication per fluid step, of this rank; the imbalance is that of all.
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
  const NeighborList& list = *run.coupled_step.neighbor_list();
  c["grains"] = grain_count(*run.state.grains);
  c["ghost_grains"] = run.state.grains->n_ghosts;
  c["grain_imbalance"] = list.partition()->imbalance();
  return c;
}

}  // namespace

std::string unfed_grains(const RunState& run) {
  if (!run.state.grains || !run.config.grains->feed) return {};
  const FeedState& feed = run.state.grains->feed;
  const std::int64_t waiting = n_waiting(feed);
  if (feed.n_fed > 0 || waiting == 0) return {};
  return fmt::format(
      "[grains.feed] has brought in no grain so far: {} wait, and all places that were tried, at x "
      "= {:.6g} m, height = {:.6g} m, are taken by grains or bodies",
      waiting, run.config.grains->feed->x, run.config.grains->feed->height);
}

void FluidStepSums::add(const FluidStepReport& report, double fluid_step, const Vec3& impulse) {
  ++steps;
  iterations += report.pressure_iterations;
  max_iterations = std::max<std::int64_t>(max_iterations, report.pressure_iterations);
  continuity_residual = std::max(continuity_residual, report.continuity_residual / fluid_step);
  courant = std::max(courant, report.courant);
  impulse_on_grains += impulse;
}

void RunAccounts::begin() {
  start = WallClock::now();
  messages_at_start = message_counts();
}

void RunAccounts::save(CheckpointWriter& file) const {
  const std::array<double, 6> numbers{
      static_cast<double>(interval.steps), static_cast<double>(interval.iterations),
      interval.continuity_residual,        interval.courant,
      interval.impulse_on_grains.x,        interval.impulse_on_grains.z};
  file.array("since_history_row", std::span<const double>(numbers));
  bodies.save(file);
}

void RunAccounts::load(const CheckpointReader& file) {
  bodies.load(file);
  if (!file.has("since_history_row")) return;
  auto numbers = file.array<double>("since_history_row", file.extents("since_history_row"));
  numbers.resize(6);  // earlier versions have four or five
  interval = {.steps = static_cast<std::int64_t>(numbers[0]),
              .iterations = static_cast<std::int64_t>(numbers[1]),
              .continuity_residual = numbers[2],
              .courant = numbers[3],
              .impulse_on_grains = {numbers[4], 0, numbers[5]}};
}

Progress RunAccounts::progress(const RunState& run, const std::optional<DuneRecord>& dune) const {
  const double seconds = std::max(seconds_since(start), 1e-9);
  Progress p;
  p.t = run.clock.time();
  p.t_start = static_cast<double>(run.clock.start) * run.clock.fluid_step;
  p.t_end = run.config.time.end;
  p.grain_steps_per_second = static_cast<double>(grain_steps) / seconds;
  if (run.state.grains) p.list_rebuilds = rebuilds_per_step(run);
  if (run.state.fluid) {
    p.cell_steps_per_second = cell_steps(run) / seconds;
    p.cfl = run.coupled_step.fluid_report().courant;
    p.pressure_iterations = run.coupled_step.fluid_report().pressure_iterations;
  }
  p.n_grains = run.n_grains;
  if (dune) p.dune_width = dune->w, p.dune_length = dune->l;
  return p;
}

nlohmann::ordered_json RunAccounts::summary(const RunState& run, const std::string& status,
                                            const std::string& message) const {
  const double wall = seconds_since(start), for_rates = std::max(wall, 1e-9);
  const int ranks = rank_count(run.ranks);
  const std::int64_t grains_at_start = run.state.grains ? run.state.grains->n_initial : 0;
  const FeedState feed = run.state.grains ? run.state.grains->feed : FeedState();
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
  json["fluid_step"] = run.clock.fluid_step;
  if (run.state.grains) json["grain_step"] = run.clock.fluid_step / run.coupled_step.substeps();
  json["wall_seconds"] = wall;
  json["phases"] = phases_per_step(run, phases);
  json["grain_steps_per_second"] = static_cast<double>(grain_steps) / for_rates;
  json["cell_steps_per_second"] = cell_steps(run) / for_rates;
  json["pressure_iterations_mean"] = per_step(run, static_cast<double>(all.iterations));
  json["pressure_iterations_max"] = all.max_iterations;
  json["max_cfl"] = all.courant;
  json["max_overlap"] = max_overlap;
  if (run.state.grains) {
    json["grain_step_over_stable"] = grain_step_over_stable;
    json["list_rebuilds"] = rebuilds_per_step(run);
  }
  json["max_continuity_residual"] = all.continuity_residual;
  if (ranks > 1) json["communication"] = communication(run, messages_at_start);
  json["ledger"] = run.coupled_step.ledger().entries();
  json["grains_initial"] = grains_at_start;
  json["grains_inside"] = run.n_grains;
  json["grains_left"] = grains_at_start + feed.n_fed - run.n_grains;
  if (run.config.grains && run.config.grains->feed) {
    json["grains_fed"] = feed.n_fed;
    json["grains_waiting"] = n_waiting(feed);
  }
  return json;
}

}  // namespace barchan
