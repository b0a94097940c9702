// run.json
#include <fstream>

#include <nlohmann/json.hpp>

#include "src/run/run_folder.hpp"

namespace barchan {

std::string to_json(const RunSummary& s) {
  nlohmann::ordered_json json;
  json["status"] = s.status;
  json["message"] = s.message;
  json["title"] = s.title;
  json["version"] = s.version;
  json["git_hash"] = s.git_hash;
  json["backend"] = s.backend;
  json["device"] = s.device;
  json["threads"] = s.threads;
  json["ranks"] = s.ranks;
  json["steps"] = s.steps;
  json["simulated_seconds"] = s.simulated_seconds;
  json["wall_seconds"] = s.wall_seconds;
  json["phases"] = s.phases;
  json["grain_steps_per_second"] = s.grain_steps_per_second;
  json["cell_steps_per_second"] = s.cell_steps_per_second;
  json["pressure_iterations_mean"] = s.pressure_iterations_mean;
  json["pressure_iterations_max"] = s.pressure_iterations_max;
  json["max_cfl"] = s.max_cfl;
  json["max_overlap"] = s.max_overlap;
  json["max_continuity_residual"] = s.max_continuity_residual;
  if (!s.communication.empty()) json["communication"] = s.communication;
  json["ledger"] = s.ledger;
  json["grains_initial"] = s.grains_initial;
  json["grains_inside"] = s.grains_inside;
  json["grains_left"] = s.grains_left;
  // Texts that are not UTF-8 (a path in the message) must not cost the summary.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string status_in(const std::filesystem::path& run_json) {
  std::ifstream in(run_json);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto status = json.find("status");
  return status != json.end() && status->is_string() ? status->get<std::string>() : std::string();
}

}  // namespace barchan
