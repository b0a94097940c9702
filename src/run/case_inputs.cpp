#include "src/run/case_inputs.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "src/case/ensemble_member.hpp"
#include "src/io/seal.hpp"

namespace barchan {

namespace fs = std::filesystem;

std::vector<CaseInput> inputs_of(const Case& the_case) {
  const Config& config = the_case.config;
  std::vector<CaseInput> inputs;
  const auto add = [&](const char* key, const fs::path& file, const auto& start) {
    if (start || !file.extension().empty()) inputs.push_back({key, file, start});
  };
  if (config.fluid) add("initial.fluid", config.initial.fluid, the_case.flow_start);
  if (config.grains) add("initial.grains", config.initial.grains, the_case.grain_start);
  return inputs;
}

nlohmann::json recorded_inputs(const fs::path& folder) {
  std::ifstream in(folder / kInputsFile);
  if (!in) return {};
  return nlohmann::json::parse(in, nullptr, false);  // damaged: "discarded", like no input
}

std::optional<fs::path> changed_input(const nlohmann::json& recorded, const Case& the_case) {
  if (recorded.is_null()) return {};
  const auto text = [](const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : std::string();
  };
  for (const auto& [key, file, start] : inputs_of(the_case)) {
    const nlohmann::json there = recorded.is_object() ? recorded.value(key, nlohmann::json()) : "";
    if (!start) {
      if (text(there) != content_key(file)) return file;
      continue;
    }
    const Case realised = ensemble_member(*start, the_case.config.initial.realisation);
    if (!there.is_object() || !says(text(there.value("config", nlohmann::json())), realised.config))
      return file;
    if (const auto behind = changed_input(there, realised)) return behind;
  }
  return {};
}

}  // namespace barchan
