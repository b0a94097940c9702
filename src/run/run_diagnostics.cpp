#include "src/run/run_diagnostics.hpp"

#include "src/diagnostics/gathered_grains.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

DuneDomain dune_domain(const Config& config) {
  const bool grains = config.grains.has_value();
  return {.length_x = config.size[0],
          .length_z = config.size[2],
          .periodic_x = grains && config.grains->boundary_x == GrainBoundaryX::periodic,
          .periodic_z = grains && config.grains->boundary_z == GrainBoundaryZ::periodic};
}

}  // namespace

RunDiagnostics::RunDiagnostics(const RunState& run)
    : config_(run.config.statistics), tracker_(dune_domain(run.config)) {
  if (!config_) return;
  statistics_.emplace(*run.config.fluid, run.state.fluid->grid);
  if (config_->fields) flow_average_.emplace(run.state.fluid->grid);
  if (config_->grain_forces) force_map_.emplace(dune_domain(run.config));
}

std::vector<DuneRow> RunDiagnostics::find_dunes(const RunState& run) {
  const GatheredGrains grains(*run.state.grains);
  largest_dune_.reset();
  if (rank_of(run.ranks) != 0) return {};
  const std::vector<DuneRow> dunes = tracker_.update(run.clock.time(), grains.cloud());
  for (const DuneRow& dune : dunes) {
    if (!largest_dune_ || dune.volume > largest_dune_->volume) largest_dune_ = dune;
  }
  return dunes;
}

std::vector<int> RunDiagnostics::dune_labels(const RunState& run) const {
  const GrainState& grains = *run.state.grains;
  const GatheredGrains all(grains);
  std::vector<int> labels;
  if (rank_of(run.ranks) == 0) labels = tracker_.labels(all.cloud());
  return from_rank_0(run.ranks, labels, grains.n);
}

bool RunDiagnostics::sample_due(const RunClock& clock) const {
  return config_ && clock.time() >= config_->start && clock.due(config_->interval);
}

void RunDiagnostics::sample(const RunState& run) {
  statistics_->sample(*run.state.fluid);
  if (flow_average_) flow_average_->sample(*run.state.fluid, run.clock.time());
  if (!force_map_) return;
  const GrainState& grains = *run.state.grains;
  const GatheredGrains all(grains);
  const auto force = gathered(grains, run.coupled_step.mean_resultant_force(grains));
  if (rank_of(run.ranks) == 0) force_map_->sample(run.clock.time(), all.cloud(), force);
}

void RunDiagnostics::write(const RunState& run, const RunFolder& folder,
                           const OutputFiles& output) {
  if (statistics_) statistics_->write(folder.file("statistics.csv"));
  if (flow_average_) flow_average_->write(output, run.clock.time(), run.clock.step);
  if (force_map_ && rank_of(run.ranks) == 0) force_map_->write(folder.file("force_map.csv"));
}

void RunDiagnostics::save(CheckpointWriter& file, MPI_Comm ranks) const {
  const std::vector<double> dunes = broadcast(tracker_.state(), ranks);
  file.array("dunes", std::span<const double>(dunes));
  if (statistics_) statistics_->save(file);
  if (flow_average_) flow_average_->save(file);
  if (force_map_) force_map_->save(file);
}

void RunDiagnostics::load(const CheckpointReader& file) {
  tracker_.set_state(file.array<double>("dunes"));
  if (statistics_) statistics_->load(file);
  if (flow_average_) flow_average_->load(file);
  if (force_map_) force_map_->load(file);
}

}  // namespace barchan
