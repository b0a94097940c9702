#include "src/run/results_writer.hpp"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "kernels/grains/clump_motion.hpp"
#include "kernels/grains/grain_sums.hpp"
#include "src/base/atomic_file.hpp"
#include "src/bodies/body_surface.hpp"
#include "src/coupling/grain_forces.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"
#include "src/restart/state_file.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/history_table.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace {

double kinetic_energy(const GrainState& grains) {
  double energy = 0;
  if (grains.clump.size() > 0) {
    const ClumpsOfGrains clumps = clumps_of(grains);
    Kokkos::parallel_reduce("history: kinetic energy of the clumps", grains.members.n,
                            ClumpKineticEnergy{clumps}, energy);
  } else {
    Kokkos::parallel_reduce("history: kinetic energy of the grains", grains.n,
                            GrainKineticEnergy{grains.kin}, energy);
  }
  return sum_over(grains.ranks, energy);
}

/// Volume flow of the grains: sum of V_p u along x or z [m^4/s].
double volume_flow(const GrainState& grains, bool along_x) {
  double flow = 0;
  Kokkos::parallel_reduce("history: flow of the grains", grains.n,
                          GrainVolumeFlow{grains.kin, along_x}, flow);
  return sum_over(grains.ranks, flow);
}

PeriodicBox box_of(const RunState& run) {
  const NeighborList* list = run.coupled_step.neighbor_list();
  return list != nullptr ? list->box() : PeriodicBox();
}

}  // namespace

ResultsWriter::ResultsWriter(const std::filesystem::path& folder, RunState& run,
                             RunDiagnostics& diagnostics, RunAccounts& accounts)
    : run_(run),
      diagnostics_(diagnostics),
      accounts_(accounts),
      folder_(prepare_folder(folder, run.restart_time, run.ranks)),
      output_(folder, run.provenance, run.restart_time, run.ranks, box_of(run),
              run.config.output.slices) {
  if (rank_of(run.ranks) != 0) return;
  action_.start = time_now();
  report::log_to(folder_ / "log.txt", run.restart_time.has_value());
  if (run.provenance.inputs.empty()) {
    remove_name(folder_ / kInputsFile);
  } else {
    write_atomically(folder_ / kInputsFile, run.provenance.inputs + "\n");
  }
  if (!run.config.bodies.empty())
    write_body_surfaces(folder_ / kBodiesFile, run.config.bodies, run.config.size, run.provenance);
  write_atomically(folder_ / "config.toml", run.provenance.config);
}

void ResultsWriter::write_due() {
  const RunClock& clock = run_.clock;
  Watchdog::heartbeat("writing results", clock.step, clock.time());
  if (run_.state.grains && clock.due(run_.config.output.dune_interval)) {
    const PhaseTimer timer(accounts_.phases, "analytics");
    for (const DuneRecord& dune : diagnostics_.find_dunes()) append_record(folder_, dune);
    diagnostics_.place_window_edge(*run_.state.grains);
    for (const HeapShare& share : diagnostics_.heap_shares()) append_record(folder_, share);
  }
  if (diagnostics_.sample_due()) {
    const PhaseTimer timer(accounts_.phases, "analytics");
    diagnostics_.sample();
  }
  const PhaseTimer timer(accounts_.phases, "output");
  const bool history = clock.due(run_.config.output.history_interval);
  if (history) write_history();
  if (history && clock.step > 0) write_bodies();
  write_probes();
  write_frames();
  if (clock.step == 0) return;
  if (restart_due() && clock.step < clock.end) write_restart();
  if (history) write_summary("running", "");
}

/// Grain step over the longest for which contacts are stable. Keeps the largest ratio, and warns of
/// the first one that exceeds one by more than the limit is uncertain.
double ResultsWriter::check_grain_step() {
  if (run_.config.grains->frozen) return 0;
  const double stable = run_.coupled_step.grain_solver()->stable_step(*run_.state.grains);
  const double ratio = run_.clock.fluid_step / run_.coupled_step.substeps() / stable;
  double& largest = accounts_.grain_step_over_stable;
  constexpr double most = 1.1;
  if (ratio > most && largest <= most) {
    report::warn(
        "t = {:.4g} s: the grain step is {:.3g} times the longest for which contacts are stable, "
        "{:.3g} s; grains that lie still shake by themselves: shorten time.grain_step",
        run_.clock.time(), ratio, stable);
  }
  largest = std::max(largest, ratio);
  return ratio;
}

void ResultsWriter::write_history() {
  const FluidStepSums& interval = accounts_.interval;
  HistoryRecord row;
  row.t = run_.clock.time();
  row.step = run_.clock.step;
  const FluidSolver* flow = run_.coupled_step.fluid_solver();
  const bool across = flow != nullptr && flow->drive().along_z();
  if (run_.state.fluid) {
    const FluidState& fluid = *run_.state.fluid;
    row.u_star = flow->friction_velocity(fluid);
    row.bulk_velocity = bulk_velocity(fluid);
    if (across) row.bulk_velocity_z = bulk_velocity_across(fluid);
    const FluidStepReport& step = run_.coupled_step.fluid_report();
    row.wanted_velocity_x = step.wanted.x, row.wanted_velocity_z = step.wanted.z;
    row.pressure_gradient = fluid.drive.x * run_.config.fluid->density;
    row.pressure_gradient_z = fluid.drive.z * run_.config.fluid->density;
    row.fluid_kinetic_energy = flow->kinetic_energy(fluid);
    row.cfl = interval.courant;
    row.continuity_residual = interval.continuity_residual;
    row.pressure_iterations = interval.mean_iterations();
  }
  if (run_.state.grains) {
    const GrainState& grains = *run_.state.grains;
    const ContactSummary contacts = run_.coupled_step.grain_solver()->contacts(grains);
    row.grain_kinetic_energy = kinetic_energy(grains);
    row.n_grains = run_.n_grains;
    row.n_fed = grains.feed.n_fed;
    row.n_contacts = contacts.n_contacts;
    row.max_overlap = contacts.max_overlap;
    accounts_.max_overlap = std::max(accounts_.max_overlap, contacts.max_overlap);
    row.grain_step_over_stable = check_grain_step();
    const double area = run_.config.size[0] * run_.config.size[2];
    const double seconds = static_cast<double>(interval.steps) * run_.clock.fluid_step;
    const GrainState whole = whole_grains(grains);
    row.grain_flux = volume_flow(whole, true) / area;
    if (across) row.grain_flux_z = volume_flow(whole, false) / area;
    if (interval.steps > 0) {
      row.stress_on_grains = interval.impulse_on_grains.x / (seconds * area);
      row.stress_on_grains_z = interval.impulse_on_grains.z / (seconds * area);
    }
  }
  if (rank_of(run_.ranks) == 0) append_record(folder_, row);
  accounts_.interval = {};
  const std::string unfed = unfed_grains(run_);
  rows_unfed_ = unfed.empty() ? 0 : rows_unfed_ + 1;
  if (rows_unfed_ == 2) report::warn("{}", unfed);
}

void ResultsWriter::write_bodies() {
  const auto rows = accounts_.bodies.take(run_.clock.time(), run_.coupled_step);
  if (rank_of(run_.ranks) != 0) return;
  for (const BodyRecord& body : rows) append_record(folder_, body);
}

void ResultsWriter::write_probes() {
  Probes* const probes = diagnostics_.probes();
  for (std::size_t n = 0; probes != nullptr && n < probes->count(); ++n) {
    if (!run_.clock.due(run_.config.output.probes[n].interval)) continue;
    const auto rows = probes->sample(n, *run_.state.fluid, run_.clock.time());
    if (rank_of(run_.ranks) == 0) append_records(folder_, rows);
  }
}

void ResultsWriter::write_frames() {
  const RunClock& clock = run_.clock;
  const OutputConfig& o = run_.config.output;
  const double t = clock.time();
  const SystemState& now = run_.state;
  const bool grains = now.grains && clock.due(o.grains_interval);
  const bool tracks = now.grains && clock.due(o.tracks_interval);
  std::optional<std::vector<int>> dunes;
  if ((grains || tracks) && o.dune_interval > 0) dunes = diagnostics_.dune_labels();
  if (grains) {
    ForceArrays forces;
    const CoupledStep& step = run_.coupled_step;
    if (o.grain_forces)
      forces = of_whole_grains(*now.grains, grain_forces(now, *step.grain_solver(), step.dt()));
    output_.write_grains(whole_grains(*now.grains), t, clock.step, forces, dunes);
  }
  if (tracks) output_.write_tracks(whole_grains(*now.grains), t, clock.step, dunes);
  if (now.fluid && clock.due(o.fields_interval)) output_.write_fields(*now.fluid, t, clock.step);
  for (const SliceConfig& slice : o.slices) {
    if (clock.due(slice.interval)) output_.write_slice(slice, *now.fluid, t, clock.step);
  }
}

/// Tells if a restart file is due, by simulated time or by the wall clock of rank 0.
bool ResultsWriter::restart_due() const {
  const RestartConfig& restart = run_.config.restart;
  if (run_.clock.due(restart.interval)) return true;
  return restart.wall_interval > 0 &&
         broadcast(seconds_since(last_restart_) > restart.wall_interval, run_.ranks);
}

void ResultsWriter::write_restart() {
  const RunClock& clock = run_.clock;
  Watchdog::heartbeat("writing a restart file", clock.step, clock.time());
  CheckpointWriter file(folder_, clock.step, run_.provenance, run_.ranks);
  save_state(file, run_.state, run_.coupled_step.neighbor_list());
  file.scalar("t", clock.time());
  file.scalar("step", clock.step);
  accounts_.save(file);
  diagnostics_.save(file);
  diagnostics_.write(folder_, output_);
  Watchdog::last_good_restart(file.commit(run_.config.restart.keep));
  last_restart_ = WallClock::now();
}

void ResultsWriter::write_summary(const std::string& status, const std::string& message) {
  const auto summary = accounts_.summary(run_, status, message);
  if (rank_of(run_.ranks) != 0) return;
  barchan::write_summary(folder_, summary);
  if (action_.status == status) return;
  action_.status = status;
  action_.message = message;
  write_ro_crate(folder_, run_.provenance, run_.config.notes, action_);
}

std::string ResultsWriter::write_failure(const StateError& problem) const {
  const double t = run_.clock.time();
  const std::int64_t step = run_.clock.step;
  const std::string message = fmt::format("{} (t = {:.6g} s, step {})", problem.what(), t, step);
  if (!problem.on_all_ranks && rank_count(run_.ranks) > 1) return message;
  try {
    const auto& [fluid, grains] = run_.state;
    const GrainState whole = grains ? whole_grains(*grains) : GrainState();
    const auto names =
        output_.write_failure(fluid ? &*fluid : nullptr, grains ? &whole : nullptr, t, step);
    return fmt::format("{}; look at it in {} ({})", message, folder_.string(),
                       fmt::join(names, ", "));
  } catch (const std::exception& second) {
    return fmt::format("{}; the state could not be written: {}", message, second.what());
  }
}

}  // namespace barchan
