#include "src/config/load.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "src/base/atomic_file.hpp"
#include "src/base/words.hpp"
#include "src/config/derived.hpp"
#include "src/config/heaps.hpp"
#include "src/config/kinds.hpp"
#include "src/config/no_effect.hpp"
#include "src/config/reading.hpp"
#include "src/config/validate.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

/// If the start `key` is a file: is it of a known kind, and there? Makes its path absolute.
void resolve_start(ConfigReader& reading, const std::string& key, fs::path& start,
                   const fs::path& folder) {
  const bool flow = key == "initial.fluid";
  const Node* node = reading.tree().find(key);
  if (node == nullptr || node->table() != nullptr || reading.is_bad(key)) return;
  if (flow && std::count(kFlowWords.begin(), kFlowWords.end(), start.string()) > 0) return;
  if (start.extension() != ".h5" && start.extension() != ".toml" &&
      (flow || start.extension() != ".csv")) {
    return reading.report_error(
        key, flow ? fmt::format("must be \"{}\" or a file ending in .h5, .toml",
                                fmt::join(kFlowWords, "\", \""))
                  : "must be a file ending in .csv, .h5, .toml, or { pour = {...} }");
  }
  const fs::path path = fs::absolute(folder / start).lexically_normal();
  std::error_code ignored;
  if (const std::string why = not_a_file(path); why.empty()) {
    start = path;
  } else if (fs::exists(path, ignored) || fs::is_symlink(path, ignored)) {
    reading.report_error(key, fmt::format("must be a file to read: {}: {}", path.string(), why));
  } else {
    reading.report_error(key, fmt::format("must be a file that exists; there is no {}{}",
                                          path.string(), nearest_file(path)));
  }
}

struct Loaded {
  Case result;
  std::vector<Problem> problems;  // of this file, then of those it starts from
};

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const std::vector<fs::path>& chain);

/// Far longer than any case, far shorter than results that are given for one by mistake.
constexpr std::uintmax_t kLongestCase = 10'000'000;

std::optional<std::string> text_of(const fs::path& file, std::vector<Problem>& problems) {
  std::string why = not_a_file(file);
  if (why.empty() && fs::file_size(file) > kLongestCase) {
    why = fmt::format("it is {} MB long, and a case is a few kB of TOML",
                      fs::file_size(file) / 1'000'000);
  }
  if (!why.empty()) {
    std::error_code ignored;
    const bool absent = !file.empty() && !fs::exists(file, ignored);
    problems.push_back({{file.empty() ? "CASE" : file.string(), 0},
                        "cannot be read: " + why + (absent ? nearest_file(file) : "")});
    return {};
  }
  return read_text(file);
}

/// Reports errors that rest on values as written: one read wrongly would only confuse.
void report(const std::vector<Finding>& findings, ConfigReader& reading) {
  for (const Finding& finding : findings) {
    const bool doubtful = std::any_of(finding.keys.begin(), finding.keys.end(),
                                      [&](const std::string& key) { return reading.is_bad(key); });
    if (finding.severity == Finding::Severity::error && !doubtful) {
      reading.report_conflict(finding.keys.front(), finding.message);
    }
  }
}

/// The case that the start `key` names, if it names one: loaded, and checked against this one.
/// `same`: it was loaded before, and its problems are told.
Loaded load_start(const Config& config, const std::string& key, const fs::path& start,
                  ConfigReader& reading, std::vector<fs::path> chain,
                  const Loaded* same = nullptr) {
  Loaded loaded;
  if (start.extension() != ".toml" || reading.is_bad(key)) return loaded;
  chain.push_back(fs::weakly_canonical(config.file));
  if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(start)) != chain.end()) {
    reading.report_conflict(key, "must not lead back to this case");
    return loaded;
  }
  if (same != nullptr) {
    loaded.result = same->result;
  } else if (const auto text = text_of(start, loaded.problems)) {
    loaded = load(*text, start, {}, chain);
  }
  if (loaded.problems.empty() && (same == nullptr || same->problems.empty())) {
    report(check_start(config, loaded.result.config, key == "initial.fluid"), reading);
  }
  return loaded;
}

/// Makes metres of what is given in diameters. `sizes`: of the grains that are poured, here or in
/// the case that this one starts from; of others [grains] sizes need not be true. `tell`: if none
/// are known.
void resolve_lengths(ConfigReader& reading, Config& config, const std::vector<SizeClass>& sizes,
                     bool tell) {
  const auto resolve = [&](const char* key, Length& length) {
    if (!length.in_diameters || reading.is_bad(key)) return;
    if (sizes.empty() && tell) {
      return reading.report_error(key,
                                  "must be in metres: diameters are known only of grains that are "
                                  "poured, in this case or in the one it starts from");
    }
    length = sizes.empty() ? 0 : length.value * mean_diameter(sizes);
  };
  resolve("coupling.smoothing_length", config.coupling.smoothing_length);
  if (config.fluid) {
    resolve("fluid.first_cell_height", config.fluid->first_cell_height);
    resolve("fluid.uniform_height", config.fluid->uniform_height);
  }
  if (!config.grains) return;
  resolve("grains.skin", config.grains->skin);
  resolve("grains.floor_diameter", config.grains->floor_diameter);
}

/// Keys of the file that an assignment has switched off are as if they were not there: who sets
/// contact_model need not delete the elastic constants. What was assigned itself must do something.
void drop_switched_off(ConfigReader& reading) {
  ConfigReader trial = reading;
  Findings found;
  check_effects(trial.read(), found);
  for (const Finding& finding : found.all) {
    const std::string &key = finding.keys[0], &rests_on = finding.keys[1];
    if (reading.is_assigned(rests_on) && !reading.is_assigned(key)) reading.drop(key);
  }
}

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const std::vector<fs::path>& chain) {
  Loaded loaded;
  ConfigReader reading(text, file);
  const bool parsed = reading.problems().empty();
  if (const Node* study = reading.tree().find("study"); study != nullptr && study->table()) {
    loaded.problems.push_back(
        {study->where, "[study]: this is a study, not a case: ./barchan sweep " + file.string()});
    return loaded;
  }
  reading.set(overrides);
  if (parsed && !overrides.empty()) drop_switched_off(reading);
  std::vector<Problem> from_starts;
  if (parsed) {
    Config& config = loaded.result.config = reading.read();
    std::vector<SizeClass>& sizes = loaded.result.sizes;
    InitialConfig& initial = config.initial;
    resolve_start(reading, "initial.fluid", initial.fluid, file.parent_path());
    resolve_start(reading, "initial.grains", initial.grains, file.parent_path());
    Loaded flow = load_start(config, "initial.fluid", initial.fluid, reading, chain);
    const bool one_for_both = initial.fluid == initial.grains && !reading.is_bad("initial.fluid");
    Loaded grains = load_start(config, "initial.grains", initial.grains, reading, chain,
                               one_for_both ? &flow : nullptr);
    from_starts = std::move(flow.problems);
    from_starts.insert(from_starts.end(), grains.problems.begin(), grains.problems.end());
    const std::vector<HeapConfig> heaps = poured_heaps(config);
    loaded.result.random = (config.fluid && (initial.fluid == "turbulent" || flow.result.random)) ||
                           (config.grains && (!heaps.empty() || grains.result.random));
    if (initial.realisation > 1 && !loaded.result.random && from_starts.empty()) {
      reading.report_conflict(
          "initial.realisation",
          "has other random numbers, and this case starts from none: its realisations "
          "would all be the same");
    }
    if (config.grains) sizes = heaps.empty() ? poured_sizes(*config.grains) : sizes_of(heaps);
    std::vector<SizeClass> of_start = grains.result.sizes;
    if (config.grains && grains.result.config.grains)
      of_start = with_kinds_of(*config.grains, *grains.result.config.grains, std::move(of_start));
    if (sizes.empty()) sizes = of_start;
    resolve_lengths(reading, config, heaps.empty() ? of_start : sizes, from_starts.empty());
    report(validate(config, sizes), reading);
    if (initial.fluid.extension() == ".toml")
      loaded.result.flow_start = std::make_shared<const Case>(std::move(flow.result));
    if (initial.grains.extension() == ".toml")
      loaded.result.grain_start = std::make_shared<const Case>(std::move(grains.result));
  }
  loaded.problems = std::move(reading.problems());
  const auto by_line = [](const Problem& a, const Problem& b) {
    return unsigned(a.where.line) - 1 < unsigned(b.where.line) - 1;  // no line: last
  };
  std::stable_sort(loaded.problems.begin(), loaded.problems.end(), by_line);
  loaded.problems.insert(loaded.problems.end(), from_starts.begin(), from_starts.end());
  return loaded;
}

/// Throws if there is any problem.
Case checked(Loaded loaded) {
  if (loaded.problems.empty()) return std::move(loaded.result);
  constexpr std::size_t max_told = 30;  // of what is no case at all there may be any number
  const std::size_t count = loaded.problems.size();
  std::vector<std::string> lines;
  for (const Problem& problem : loaded.problems) {
    if (lines.size() == max_told) break;
    lines.push_back(printable(fmt::format("{}: {}", to_string(problem.where), problem.text)));
  }
  if (count > lines.size()) lines.push_back(fmt::format("  ... and {} more", count - lines.size()));
  lines.push_back(fmt::format("{} problem{}; nothing was run.", count, count == 1 ? "" : "s"));
  throw ConfigError(std::move(lines));
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> lines)
    : InputError(fmt::format("{}", fmt::join(lines, "\n"))), lines_(std::move(lines)) {}

Case load_case(const fs::path& file, const std::vector<std::string>& overrides) {
  Loaded nothing;
  const auto text = text_of(file, nothing.problems);
  return checked(text ? load(*text, file, overrides, {}) : std::move(nothing));
}

Case load_case_text(std::string_view text, const fs::path& file,
                    const std::vector<std::string>& overrides) {
  return checked(load(text, file, overrides, {}));
}

Config load_config(const fs::path& file, const std::vector<std::string>& overrides) {
  return load_case(file, overrides).config;
}

Config load_config_text(std::string_view text, const fs::path& file,
                        const std::vector<std::string>& overrides) {
  return load_case_text(text, file, overrides).config;
}

Config config_as_written(std::string_view resolved, const fs::path& file) {
  return ConfigReader(resolved, file).read();
}

bool says(std::string_view resolved, const Config& config) {
  ConfigReader reading(resolved, config.file);
  return reading.read() == config && !reading.has_bad_keys();
}

bool is_written_in(const fs::path& file, const Config& config) {
  std::vector<Problem> unreadable;
  const auto text = text_of(file, unreadable);
  return text && says(*text, config);
}

}  // namespace barchan
