#include "src/run/ro_crate.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/atomic_file.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "#barchan";

Json id_of(const std::string& id) { return {{"@id", id}}; }

Json status_of(std::string_view status) {
  return id_of(fmt::format("http://schema.org/{}ActionStatus", status));
}

const char* format_of(const fs::path& name) {
  const fs::path ending = name.extension();
  if (ending == ".h5") return "application/x-hdf5";
  if (ending == ".csv") return "text/csv";
  if (ending == ".json") return "application/json";
  if (ending == ".toml") return "application/toml";
  if (ending == ".xdmf") return "application/xml";
  return "text/plain";
}

/// Files of the run, by name.
Json files_in(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name != kCrateFile && entry.is_regular_file() && !meaning_of(name).empty())
      names.push_back(name);
  }
  std::ranges::sort(names);
  Json files = Json::array();
  for (const fs::path& name : names) {
    files.push_back({{"@id", name.string()},
                     {"@type", "File"},
                     {"name", name.string()},
                     {"description", meaning_of(name)},
                     {"encodingFormat", format_of(name)}});
  }
  return files;
}

Json described(const CrateAction& run) {
  Json action{{"startTime", run.start}};
  if (run.status != "running") action["endTime"] = time_now();
  action["actionStatus"] = status_of(run.status == "running"  ? "Active"
                                     : run.status == "failed" ? "Failed"
                                                              : "Completed");
  if (!run.message.empty()) action[run.status == "failed" ? "error" : "description"] = run.message;
  return action;
}

/// Actions that a file lists before the one with this start. Others may have written it.
Json actions_before(const fs::path& file, const std::string& start) {
  std::ifstream in(file);
  const Json crate = Json::parse(in, nullptr, false);
  const auto graph = crate.find("@graph");
  Json actions = Json::array();
  if (graph == crate.end() || !graph->is_array()) return actions;
  for (const Json& entity : *graph) {
    if (!entity.is_object() || entity.value("@type", Json()) != "CreateAction") continue;
    if (entity.value("startTime", Json(start)) == start) continue;
    Json action = Json::object();
    for (const char* key : {"startTime", "endTime", "actionStatus", "error", "description"}) {
      if (const auto at = entity.find(key); at != entity.end()) action[key] = *at;
    }
    if (!action.contains("endTime")) action["actionStatus"] = status_of("Failed");
    actions.push_back(action);
  }
  return actions;
}

/// References to entities.
Json references(const Json& entities) {
  Json ids = Json::array();
  for (const Json& entity : entities) ids.push_back(id_of(entity.at("@id")));
  return ids;
}

}  // namespace

std::string time_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::time_t(milliseconds / 1000)),
                     milliseconds % 1000);
}

void write_ro_crate(const fs::path& folder, const Provenance& provenance, const std::string& notes,
                    const CrateAction& run) {
  const Json files = files_in(folder);
  Json given = Json::array(), results = Json::array();
  for (const Json& file : references(files)) {
    const bool is_given = file["@id"] == "config.toml" || file["@id"] == kInputsFile;
    (is_given ? given : results).push_back(file);
  }
  Json actions = actions_before(folder / kCrateFile, run.start);
  actions.push_back(described(run));
  for (std::size_t n = 0; n < actions.size(); ++n) {
    Json action{{"@id", fmt::format("#run-{}", n + 1)},
                {"@type", "CreateAction"},
                {"name", n == 0 ? "run of the case" : "run of the case, continued"},
                {"instrument", id_of(kProgram)},
                {"object", given},
                {"result", results}};
    action.update(actions[n]);
    actions[n] = action;
  }
  const std::string what = "Simulation of grains and water with Barchan";
  Json graph = Json::array({{{"@id", kCrateFile},
                             {"@type", "CreativeWork"},
                             {"conformsTo", id_of("https://w3id.org/ro/crate/1.1")},
                             {"about", id_of("./")}},
                            {{"@id", "./"},
                             {"@type", "Dataset"},
                             {"name", provenance.title.empty() ? what : provenance.title},
                             {"description", notes.empty() ? what : notes},
                             {"datePublished", time_now()},
                             {"hasPart", references(files)},
                             {"mentions", references(actions)}},
                            {{"@id", kProgram},
                             {"@type", "SoftwareApplication"},
                             {"name", "Barchan"},
                             {"softwareVersion", provenance.version},
                             {"identifier", provenance.git_hash}}});
  for (const Json& list : {actions, files}) graph.insert(graph.end(), list.begin(), list.end());
  const Json crate{{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}};
  const auto replace = Json::error_handler_t::replace;  // as in run.json
  write_atomically(folder / kCrateFile, crate.dump(2, ' ', false, replace) + "\n");
}

}  // namespace barchan
