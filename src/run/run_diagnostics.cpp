#include "src/run/run_diagnostics.hpp"

#include <cmath>

#include "src/case/derived.hpp"
#include "src/coupling/grain_forces.hpp"
#include "src/diagnostics/gathered_grains.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

DuneDomain dune_domain(const Config& config) {
  const bool grains = config.grains.has_value();
  return {.length_x = config.size[0],
          .length_z = config.size[2],
          .periodic_x = is_periodic_x(config),
          .periodic_z = grains && config.grains->boundary_z == GrainBoundaryZ::periodic};
}

BedLoad::Surroundings surroundings(const Config& config) {
  const auto& [x, y, z] = config.grains->gravity;
  return {.fluid_density = config.fluid->density,
          .viscosity = config.fluid->kinematic_viscosity,
          .gravity = {x, y, z},
          .fluid_in_grains = config.coupling.scheme == CouplingScheme::resolved};
}

}  // namespace

RunDiagnostics::RunDiagnostics(const RunState& run) : run_(run), tracker_(dune_domain(run.config)) {
  if (!run.config.output.probes.empty()) probes_.emplace(run.config);
  const auto& config = run.config.statistics;
  if (!config) return;
  statistics_.emplace(*run.config.fluid, run.state.fluid->grid);
  if (config->fields) flow_average_.emplace(run.state.fluid->grid);
  if (config->grain_forces) force_map_.emplace(dune_domain(run.config));
  if (config->bed_load) bed_load_.emplace(surroundings(run.config), run.state.fluid->grid);
}

std::vector<DuneRecord> RunDiagnostics::find_dunes() {
  const std::vector<GrainSample> grains = gathered_grains(*run_.state.grains);
  largest_dune_.reset();
  heap_shares_.clear();
  if (rank_of(run_.ranks) != 0) return {};
  const std::vector<DuneRecord> dunes =
      tracker_.update(run_.clock.time(), grains, run_.state.grains->feed.n_fed);
  for (const DuneRecord& dune : dunes) {
    if (!largest_dune_ || dune.volume > largest_dune_->volume) largest_dune_ = dune;
  }
  if (are_of_heaps(grains))
    heap_shares_ = barchan::heap_shares(run_.clock.time(), grains, tracker_.labels(grains));
  return dunes;
}

std::vector<int> RunDiagnostics::dune_labels() const {
  const GrainState& grains = *run_.state.grains;
  const std::vector<GrainSample> all = gathered_grains(grains);
  std::vector<int> labels;
  if (rank_of(run_.ranks) == 0) labels = tracker_.labels(all);
  return from_rank_0(run_.ranks, labels, grain_count(grains));
}

void RunDiagnostics::place_window_edge(GrainState& grains) const {
  if (run_.config.grains->boundary_x != GrainBoundaryX::follow) return;
  const double lx = run_.config.size[0];
  std::vector<double> edge;
  if (largest_dune_) edge = {std::fmod(largest_dune_->cx + lx / 2, lx)};
  edge = broadcast(edge, run_.ranks);
  if (!edge.empty()) grains.window_edge = edge.front();
}

bool RunDiagnostics::sample_due() const {
  const auto& config = run_.config.statistics;
  return config && run_.clock.time() >= config->start && run_.clock.due(config->interval);
}

void RunDiagnostics::sample() {
  statistics_->sample(*run_.state.fluid);
  if (flow_average_) flow_average_->sample(*run_.state.fluid, run_.clock.time());
  if (bed_load_) bed_load_->sample(*run_.state.fluid, *run_.state.grains, run_.clock.time());
  if (!force_map_) return;
  const GrainState& grains = *run_.state.grains;
  const std::vector<GrainSample> all = gathered_grains(grains);
  const auto mine = host_copy(mean_resultant_force(grains, run_.coupled_step.dt()));
  const auto force =
      on_rank_0(grains.ranks, std::vector<Vec3>(mine.data(), mine.data() + grain_count(grains)));
  if (rank_of(run_.ranks) == 0) force_map_->sample(run_.clock.time(), all, force);
}

void RunDiagnostics::write(const std::filesystem::path& folder, const OutputFiles& output) {
  if (statistics_) statistics_->write(folder / "statistics.csv");
  if (flow_average_) flow_average_->write(output, run_.clock.time(), run_.clock.step);
  if (force_map_ && rank_of(run_.ranks) == 0) force_map_->write(folder / "force_map.csv");
  if (bed_load_) bed_load_->write(folder / "bedload.csv");
}

void RunDiagnostics::save(CheckpointWriter& file) const {
  const std::vector<double> dunes = broadcast(tracker_.state(), run_.ranks);
  file.array("dunes", std::span<const double>(dunes));
  if (statistics_) statistics_->save(file);
  if (flow_average_) flow_average_->save(file);
  if (force_map_) force_map_->save(file);
  if (bed_load_) bed_load_->save(file);
}

void RunDiagnostics::load(const CheckpointReader& file) {
  tracker_.set_state(file.array<double>("dunes"));
  if (statistics_) statistics_->load(file);
  if (flow_average_) flow_average_->load(file);
  if (force_map_) force_map_->load(file);
  if (bed_load_) bed_load_->load(file);
}

}  // namespace barchan
