#include "src/app/info_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/base/atomic_file.hpp"
#include "src/base/report.hpp"
#include "src/base/words.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

Json parse(const fs::path& file) {
  Json json = Json::parse(read_text(file), nullptr, false);
  if (!json.is_object())
    throw std::runtime_error("cannot read " + file.string() + ": it is damaged: not a JSON object");
  return json;
}

std::string word(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_string() ? printable(at->get<std::string>(), 500)
                                             : std::string("unknown");
}

/// Number of a key; empty if it is not there, as in another version or while the run goes on.
std::optional<double> number(const Json& json, const char* key) {
  const auto at = json.find(key);
  if (at == json.end() || !at->is_number()) return {};
  return at->get<double>();
}

struct Extreme {
  const char *key, *words, *unit;
};
constexpr Extreme kExtremes[] = {
    {"max_cfl", "largest CFL number", ""},
    {"max_overlap", "largest overlap over the mean diameter", ""},
    {"grain_step_over_stable", "grain step over the longest stable one", ""},
    {"max_continuity_residual", "largest residual of continuity", " 1/s"},
    {"pressure_iterations_max", "most pressure iterations in a step", ""}};

std::string describe_progress(const Json& json) {
  std::string text;
  if (const auto simulated = number(json, "simulated_seconds")) {
    text += fmt::format("time     {:.6g} s", *simulated);
    if (const auto steps = number(json, "steps")) text += fmt::format(", step {:.0f}", *steps);
    if (const auto wall = number(json, "wall_seconds"))
      text += ", computed in " + format_duration(*wall);
    text += '\n';
  }
  if (const auto at_first = number(json, "grains_initial"); at_first.value_or(0) > 0) {
    text += fmt::format("grains   {:.0f} at first, {:.0f} left the domain\n", *at_first,
                        number(json, "grains_left").value_or(0));
  }
  std::string extremes;
  for (const auto& [key, words, unit] : kExtremes) {
    if (const auto value = number(json, key))
      extremes += fmt::format("  {:<40} {:.4g}{}\n", words, *value, unit);
  }
  return text + (extremes.empty() ? "" : "extremes of the run:\n" + extremes);
}

std::string describe_files(const fs::path& folder) {
  std::vector<std::string> lines;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code error;
    const auto size = entry.file_size(error);
    if (error || !is_result_name(entry.path().filename())) continue;
    lines.push_back(fmt::format("  {:<24} {:>12.3f} MB\n", entry.path().filename().string(),
                                static_cast<double>(size) / 1e6));
  }
  std::ranges::sort(lines);
  return fmt::format("files:\n{}", fmt::join(lines, ""));
}

std::string describe_run(const fs::path& folder) {
  const Json json = parse(folder / "run.json");
  const std::string message = word(json, "message");
  const bool silent = message.empty() || message == "unknown";
  return fmt::format("kind     run folder\ntitle    {}\nstatus   {}{}\n", word(json, "title"),
                     word(json, "status"), silent ? "" : ": " + message) +
         fmt::format("written  by barchan {} ({}), {}\n", word(json, "version"),
                     word(json, "git_hash"), word(json, "device")) +
         describe_progress(json) + describe_files(folder);
}

std::string describe_study(const fs::path& folder) {
  const Json json = parse(folder / "study.json");
  std::string text = fmt::format("kind     study folder\ntitle    {}\nbase     {}\n",
                                 word(json, "title"), word(json, "base"));
  const auto cases = json.find("cases");
  if (cases == json.end() || !cases->is_array()) return text + "cases    none\n";
  text += fmt::format("cases    {}\n", cases->size());
  for (const Json& one : *cases) {
    if (!one.is_object()) continue;
    const std::string name = word(one, "folder");
    const std::string status = status_in(folder / name / "run.json");
    text += fmt::format("  {:<40} {}\n", name, status.empty() ? "waiting" : printable(status, 40));
  }
  return text;
}

}  // namespace

std::string describe_folder(const fs::path& folder) {
  const std::string head = folder.string() + "\n";
  if (fs::exists(folder / "study.json")) return head + describe_study(folder);
  if (fs::exists(folder / "run.json")) return head + describe_run(folder);
  throw std::runtime_error(
      folder.string() + " is a folder without run.json or study.json: neither a run nor a study");
}

}  // namespace barchan
