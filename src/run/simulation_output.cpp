// What a run writes: tables, frames, restarts, summary.
#include <fmt/ranges.h>

#include <algorithm>

#include "kernels/grains/grain_sums.hpp"
#include "src/diagnostics/gathered_grains.hpp"
#include "src/output/state_file.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/reduce.hpp"
#include "src/run/run_identity.hpp"
#include "src/run/simulation.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace {

double kinetic_energy(const GrainState& grains) {
  double energy = 0;
  Kokkos::parallel_reduce("history: kinetic energy of the grains", grains.n,
                          GrainKineticEnergy{grains.kin}, energy);
  return sum_over(grains.ranks, energy);
}

}  // namespace

void Simulation::write_history() {
  HistoryRow row;
  row.t = time();
  row.step = step_;
  if (state_.fluid) {
    row.u_star = coupled_step_.friction_velocity(state_);
    row.bulk_velocity = coupled_step_.bulk_velocity(state_);
    row.pressure_gradient = state_.fluid->drive * config_.fluid->density;
    row.fluid_kinetic_energy = coupled_step_.kinetic_energy_of_fluid(state_);
    row.cfl = interval_.courant;
    row.continuity_residual = interval_.continuity_residual;
    row.pressure_iterations = interval_.steps > 0 ? static_cast<double>(interval_.iterations) /
                                                        static_cast<double>(interval_.steps)
                                                  : 0;
  }
  if (state_.grains) {
    const ContactSummary contacts = coupled_step_.contacts(state_);
    row.grain_kinetic_energy = kinetic_energy(*state_.grains);
    row.n_grains = n_grains_;
    row.n_contacts = contacts.n_contacts;
    row.max_overlap = contacts.max_overlap;
    max_overlap_ = std::max(max_overlap_, contacts.max_overlap);
  }
  folder_->append(row);
  interval_ = Interval{};
}

/// Rank 0 looks at the dunes of all.
void Simulation::write_dunes() {
  const GatheredGrains grains(*state_.grains);
  largest_dune_.reset();
  if (rank_of(ranks_) != 0) return;
  for (const DuneRow& dune : tracker_.update(time(), grains.cloud())) {
    folder_->append(dune);
    if (!largest_dune_ || dune.volume > largest_dune_->volume) largest_dune_ = dune;
  }
}

void Simulation::sample_forces() {
  const GatheredGrains grains(*state_.grains);
  const std::vector<Vec3> force =
      gathered(*state_.grains, coupled_step_.mean_resultant_force(*state_.grains));
  if (rank_of(ranks_) == 0) force_map_->sample(time(), grains.cloud(), force);
}

void Simulation::save_statistics(CheckpointWriter& file) const {
  if (statistics_) statistics_->save(file);
  if (flow_average_) flow_average_->save(file);
  if (force_map_) force_map_->save(file);
}

void Simulation::load_statistics(const CheckpointReader& file) {
  if (statistics_) statistics_->load(file);
  if (flow_average_) flow_average_->load(file);
  if (force_map_) force_map_->load(file);
}

void Simulation::write_statistics() {
  if (statistics_) statistics_->write(folder_->file("statistics.csv"));
  if (flow_average_) flow_average_->write(*output_, time(), step_);
  if (force_map_ && rank_of(ranks_) == 0) force_map_->write(folder_->file("force_map.csv"));
}

void Simulation::write_grains() {
  std::vector<NamedForce> forces;
  if (config_.output.grain_forces) forces = coupled_step_.grain_forces(state_);
  output_->write_grains(*state_.grains, time(), step_, forces);
}

void Simulation::write_restart() {
  Watchdog::beat("writing a restart file", step_, time());
  CheckpointWriter file(folder_->path(), step_, provenance_, ranks_);
  save_state(file, state_, coupled_step_);
  file.scalar("t", time());
  file.scalar("step", step_);
  const std::vector<double> dunes = broadcast(tracker_.state(), ranks_);
  file.array("dunes", std::span<const double>(dunes));
  const std::vector<double> since_row{static_cast<double>(interval_.steps),
                                      static_cast<double>(interval_.iterations),
                                      interval_.continuity_residual, interval_.courant};
  file.array("since_history_row", std::span<const double>(since_row));
  save_statistics(file);
  write_statistics();
  Watchdog::last_good_restart(file.commit(config_.restart.keep));
  last_restart_at_ = WallClock::now();
}

std::optional<std::filesystem::path> Simulation::last_restart() const {
  if (auto written = latest_checkpoint(options_.folder)) return written;
  return options_.restart;
}

/// Files to look at what went wrong in; returns the message with their names. They are a help: that
/// they cannot be written must not hide why the run failed.
std::string Simulation::write_failure(const StateError& problem) {
  std::string message = fmt::format("{} (t = {:.6g} s, step {})", problem.what(), time(), step_);
  if (!problem.on_all_ranks && rank_count(ranks_) > 1) return message;
  try {
    const auto names =
        output_->write_failure(state_.fluid ? &*state_.fluid : nullptr,
                               state_.grains ? &*state_.grains : nullptr, time(), step_);
    return fmt::format("{}; look at it in {} ({})", message, options_.folder.string(),
                       fmt::join(names, ", "));
  } catch (const std::exception& second) {
    return fmt::format("{}; the state could not be written: {}", message, second.what());
  }
}

/// Per fluid step, of this rank; the imbalance is that of all.
std::map<std::string, double> Simulation::communication() const {
  const double steps = std::max<double>(1, static_cast<double>(step_ - start_step_));
  const MessageCounts& now = message_counts();
  std::map<std::string, double> c;
  c["messages"] = static_cast<double>(now.messages - messages_at_start_.messages) / steps;
  c["megabytes"] = 1e-6 * static_cast<double>(now.bytes - messages_at_start_.bytes) / steps;
  c["reductions"] = static_cast<double>(now.reductions - messages_at_start_.reductions) / steps;
  c["all_to_alls"] = static_cast<double>(now.all_to_alls - messages_at_start_.all_to_alls) / steps;
  if (!state_.grains) return c;
  const NeighborList& list = coupled_step_.neighbor_list();
  c["grains"] = state_.grains->n;
  c["ghost_grains"] = state_.grains->n_ghosts;
  c["grain_imbalance"] = list.partition()->imbalance();
  c["list_rebuilds"] = static_cast<double>(list.rebuilds()) / steps;
  return c;
}

RunSummary Simulation::summary(const std::string& status, const std::string& message) const {
  RunSummary s;
  s.status = status;
  s.message = message;
  s.title = provenance_.title;
  s.version = provenance_.version;
  s.git_hash = provenance_.git_hash;
  s.backend = Kokkos::DefaultExecutionSpace::name();
  s.device = device_name();
  s.ranks = rank_count(ranks_);
  s.threads = Kokkos::DefaultExecutionSpace().concurrency();
  s.steps = step_;
  s.simulated_seconds = time();
  s.wall_seconds = seconds_since(wall_start_);
  const double steps = std::max<double>(1, static_cast<double>(step_ - start_step_));
  for (const Phases* phases : {&coupled_step_.phases(), &phases_}) {
    for (const auto& [name, seconds] : *phases) s.phases[name] = seconds / steps;
  }
  const double wall = std::max(s.wall_seconds, 1e-9);
  s.grain_steps_per_second = static_cast<double>(grain_steps_) / wall;
  if (state_.fluid) {
    const Grid& g = state_.fluid->grid;
    s.cell_steps_per_second =
        static_cast<double>(step_ - start_step_) * g.nx_all * g.ny * g.nz_all / wall;
  }
  s.pressure_iterations_mean = static_cast<double>(iterations_sum_) / steps;
  s.pressure_iterations_max = iterations_max_;
  s.max_cfl = max_courant_;
  s.max_overlap = max_overlap_;
  s.max_continuity_residual = max_residual_;
  if (s.ranks > 1) s.communication = communication();
  s.ledger = coupled_step_.ledger().entries();
  if (state_.grains) {
    s.grains_initial = state_.grains->n_initial;
    s.grains_inside = n_grains_;
    s.grains_left = s.grains_initial - n_grains_;
  }
  return s;
}

void Simulation::write_summary(const std::string& status, const std::string& message) {
  folder_->write_summary(summary(status, message));
}

}  // namespace barchan
