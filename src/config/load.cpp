#include "src/config/load.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "src/base/input_file.hpp"
#include "src/base/printable.hpp"
#include "src/config/section.hpp"
#include "src/config/start.hpp"
#include "src/config/validate.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

/// A title stands in tables, pages and pictures.
void read_title(Section& s, std::string& title) {
  constexpr std::size_t longest = 200;
  s.optional("title", title);
  const Node* node = s.take("title");
  if (printable_lines(title) != title) {
    s.complain("title", *node, "must be text without control characters");
  }
  if (title.size() > longest) {
    s.complain("title", *node, fmt::format("must be at most {} bytes long", longest));
  }
}

void read(Section& s, TimeConfig& c) {
  s.require("end", c.end, {above(0)});
  s.optional("fluid_step", c.fluid_step, {above(0), at_most(1)});
  s.optional("grain_step", c.grain_step, {above(0), at_most(1)});
  s.optional("wall_clock_limit", c.wall_clock_limit, {at_least(0)});
}

void read(Section& s, FluidConfig& c) {
  s.require("cells", c.cells, {at_least(1), at_most(100000)});
  s.optional("first_cell_height", c.first_cell_height, {at_least(0)});
  s.optional("density", c.density, {above(0)});
  s.optional("kinematic_viscosity", c.kinematic_viscosity, {at_least(0)});
  s.optional("mean_velocity", c.mean_velocity, {at_least(0)});
  s.optional("pressure_gradient", c.pressure_gradient);
  s.optional("ramp_time", c.ramp_time, {at_least(0)});
  s.optional("turbulence", c.turbulence);
  s.optional("wale_constant", c.wale_constant, {at_least(0), at_most(2)});
  s.optional("bottom", c.bottom);
  s.optional("top", c.top);
  s.optional("top_velocity", c.top_velocity);
}

void read(Section& s, Material& c) {
  s.optional("youngs_modulus", c.youngs_modulus, {above(0)});
  s.optional("poisson_ratio", c.poisson_ratio, {at_least(0), at_most(0.5)});
  s.optional("restitution", c.restitution, {above(0), at_most(1)});
  s.optional("sliding_friction", c.sliding_friction, {at_least(0)});
  s.optional("rolling_friction", c.rolling_friction, {at_least(0)});
}

void read(Section& s, GrainConfig& c, Reading& reading) {
  s.optional("density", c.density, {above(0)});
  read(s, c.material);
  c.wall = c.material;
  Section wall(reading, s.take("wall"), "grains.wall");
  read(wall, c.wall);
  s.optional("coulomb_limit", c.coulomb_limit);
  s.optional("rolling_model", c.rolling_model);
  s.optional("rolling_theta_m", c.rolling_theta_m, {above(0)});
  s.optional("contact_model", c.contact_model);
  s.optional("linear_stiffness", c.linear_stiffness, {at_least(0)});
  s.optional("sizes", c.sizes);
  s.optional("frozen", c.frozen);
  s.optional("boundary_x", c.boundary_x);
  s.optional("boundary_z", c.boundary_z);
  s.optional("gravity", c.gravity);
  s.optional("skin", c.skin, {at_least(0)});
  s.optional("max_overlap", c.max_overlap, {above(0), at_most(1)});
  AmbientConfig ambient;
  Section around(reading, s.take("ambient"), "grains.ambient");
  around.optional("density", ambient.density, {above(0)});
  around.optional("kinematic_viscosity", ambient.kinematic_viscosity, {above(0)});
  if (around.present()) c.ambient = ambient;
}

void read(Section& s, CouplingConfig& c) {
  s.optional("drag", c.drag);
  s.optional("void_fraction", c.void_fraction);
  s.optional("smoothing_length", c.smoothing_length, {at_least(0)});
  s.optional("alpha_time_derivative", c.alpha_time_derivative);
  s.optional("relaxation", c.relaxation);
  s.optional("forces", c.forces);
}

/// A start that is a file: known extension, there, and its path made absolute.
void resolve_start(Section& s, std::string_view key, std::string& start,
                   const std::vector<std::string>& extensions, const fs::path& folder) {
  const Node* node = s.take(key);
  const fs::path written = start;
  const std::string extension = written.extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    const std::string words = key == "fluid" ? "\"still\", \"turbulent\" or " : "";
    s.complain(key, *node,
               fmt::format("must be {}a file ending in {}{}", words, fmt::join(extensions, ", "),
                           key == "grains" ? ", or { pour = {...} }" : ""));
    return;
  }
  const fs::path path = fs::absolute(folder / written).lexically_normal();
  if (const std::string why = not_a_file(path); !why.empty()) {
    std::error_code ignored;
    s.complain(key, *node,
               fs::exists(path, ignored)
                   ? fmt::format("must be a file to read: {}: {}", path.string(), why)
                   : fmt::format("must be a file that exists; there is no {}", path.string()));
    return;
  }
  start = path.string();
}

void read_pour(Section& s, PourConfig& c) {
  s.optional("centre", c.centre);
  s.require("radius", c.radius, {above(0)});
  s.optional("drop_height", c.drop_height, {at_least(0)});
  s.optional("seed", c.seed);
}

void read(Section& s, InitialConfig& c, Reading& reading, const fs::path& folder) {
  s.optional("seed", c.seed);
  s.optional("fluid", c.fluid);
  if (c.fluid != "still" && c.fluid != "turbulent") {
    resolve_start(s, "fluid", c.fluid, {".h5", ".toml"}, folder);
  }
  const Node* grains = s.take("grains");
  const bool described = grains != nullptr && grains->table() != nullptr;
  if (grains != nullptr && !described) {
    s.optional("grains", c.grains);
    if (std::holds_alternative<std::string>(grains->value)) {
      resolve_start(s, "grains", c.grains, {".csv", ".h5", ".toml"}, folder);
    }
  }
  Section table(reading, described ? grains : nullptr, "initial.grains");
  const Node* pour_node = table.take("pour");
  Section pour(reading, pour_node, "initial.grains.pour");
  PourConfig poured;
  read_pour(pour, poured);
  if (pour.present()) c.pour = poured;
  if (described && pour_node == nullptr) {
    s.complain("grains", *grains, "must be a file or { pour = {...} }");
  }
}

void read(Section& s, OutputConfig& c) {
  s.optional("history_interval", c.history_interval, {at_least(0)});
  s.optional("dune_interval", c.dune_interval, {at_least(0)});
  s.optional("grains_interval", c.grains_interval, {at_least(0)});
  s.optional("fields_interval", c.fields_interval, {at_least(0)});
  s.optional("tracks_interval", c.tracks_interval, {at_least(0)});
  s.optional("grain_forces", c.grain_forces);
}

void read(Section& s, RestartConfig& c) {
  s.optional("interval", c.interval, {at_least(0)});
  s.optional("wall_interval", c.wall_interval, {at_least(0)});
  s.optional("keep", c.keep, {at_least(1), at_most(1000)});
}

void read(Section& s, StatisticsConfig& c) {
  s.require("start", c.start, {at_least(0)});
  s.optional("interval", c.interval, {above(0)});
  s.optional("fields", c.fields);
  s.optional("grain_forces", c.grain_forces);
}

void read(Section& s, SolverConfig& c) {
  s.optional("pressure_tolerance", c.pressure_tolerance, {above(0), below(1)});
  s.optional("max_iterations", c.max_iterations, {at_least(1)});
  s.optional("correctors", c.correctors, {at_least(1), at_most(100)});
  s.optional("preconditioner", c.preconditioner);
}

/// Calls `fill` with the section of that name, present or not: its keys become known either way.
template <class Fill>
bool with_section(Reading& reading, Section& root, std::string_view name, Fill fill) {
  Section section(reading, root.take(name), std::string(name));
  fill(section);
  return section.present();
}

void require_section(Reading& reading, bool present, const std::string& name) {
  if (!present && !reading.is_bad(name)) {
    reading.complain_about_missing(name);
  }
}

Config read_tree(Reading& reading, const Node& tree, const fs::path& file) {
  Config c;
  c.file = file;
  FluidConfig fluid;
  GrainConfig grains;
  {
    Section root(reading, &tree, "");
    with_section(reading, root, "case", [&](Section& s) { read_title(s, c.title); });
    const bool time = with_section(reading, root, "time", [&](Section& s) { read(s, c.time); });
    require_section(reading, time, "time");
    const bool domain = with_section(reading, root, "domain",
                                     [&](Section& s) { s.require("size", c.size, {above(0)}); });
    require_section(reading, domain, "domain");
    if (with_section(reading, root, "fluid", [&](Section& s) { read(s, fluid); })) c.fluid = fluid;
    if (with_section(reading, root, "grains", [&](Section& s) { read(s, grains, reading); })) {
      c.grains = grains;
    }
    with_section(reading, root, "coupling", [&](Section& s) { read(s, c.coupling); });
    with_section(reading, root, "initial",
                 [&](Section& s) { read(s, c.initial, reading, file.parent_path()); });
    with_section(reading, root, "output", [&](Section& s) { read(s, c.output); });
    with_section(reading, root, "restart", [&](Section& s) { read(s, c.restart); });
    StatisticsConfig statistics;
    if (with_section(reading, root, "statistics", [&](Section& s) { read(s, statistics); })) {
      c.statistics = statistics;
    }
    with_section(reading, root, "solver", [&](Section& s) { read(s, c.solver); });
  }
  reading.complain_about_unknown();
  return c;
}

struct Loaded {
  Config config;
  std::vector<SizeClass> sizes;   // of the grains, if known
  std::vector<Problem> problems;  // of this file, then of those it starts from
};

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const std::vector<fs::path>& chain);

/// Far longer than any case, far shorter than results that are given for one by mistake.
constexpr std::uintmax_t longest_case = 10'000'000;

std::optional<std::string> read_text(const fs::path& file, std::vector<Problem>& problems) {
  std::string why = not_a_file(file);
  if (why.empty() && fs::file_size(file) > longest_case) {
    why = fmt::format("it is {} MB long, and a case is a few kB of TOML",
                      fs::file_size(file) / 1'000'000);
  }
  if (!why.empty()) {
    problems.push_back({{file.empty() ? "CONFIG" : file.string(), 0}, "cannot be read: " + why});
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// Reports errors that rest on values as written: one read wrongly would only confuse.
void report(const std::vector<Finding>& findings, Reading& reading) {
  for (const Finding& finding : findings) {
    const bool doubtful = std::any_of(finding.keys.begin(), finding.keys.end(),
                                      [&](const std::string& key) { return reading.is_bad(key); });
    if (finding.severity == Finding::Severity::error && !doubtful) {
      reading.contradict(finding.keys.front(), finding.message);
    }
  }
}

/// The case that `key` names, if it names one: loaded, and checked against this one.
std::optional<Loaded> load_start(const Config& config, const std::string& key, Reading& reading,
                                 std::vector<fs::path> chain) {
  const bool flow = key == "initial.fluid";
  const fs::path start = flow ? config.initial.fluid : config.initial.grains;
  if (start.extension() != ".toml" || reading.is_bad(key)) return {};
  chain.push_back(fs::weakly_canonical(config.file));
  if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(start)) != chain.end()) {
    reading.contradict(key, "must not lead back to this case");
    return {};
  }
  Loaded loaded;
  if (const auto text = read_text(start, loaded.problems)) loaded = load(*text, start, {}, chain);
  if (loaded.problems.empty()) report(check_start(config, loaded.config, flow), reading);
  return loaded;
}

void sort_by_line(std::vector<Problem>& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return unsigned(a.where.line) - 1 < unsigned(b.where.line) - 1;  // no line: last
  });
}

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const std::vector<fs::path>& chain) {
  Reading reading(file.string());
  Node tree = parse_toml(text, reading.file(), reading.problems());
  const bool parsed = reading.problems().empty();
  for (const std::string& assignment : overrides) {
    apply_override(tree, assignment, reading.problems());
  }
  Loaded loaded;
  std::vector<Problem> from_starts;
  if (parsed) {
    loaded.config = read_tree(reading, tree, file);
    if (loaded.config.grains) loaded.sizes = loaded.config.grains->sizes;
    for (const char* key : {"initial.fluid", "initial.grains"}) {
      const auto start = load_start(loaded.config, key, reading, chain);
      if (!start) continue;
      // Flow and grains may come from one case: its problems once.
      if (loaded.config.initial.fluid != loaded.config.initial.grains || from_starts.empty()) {
        from_starts.insert(from_starts.end(), start->problems.begin(), start->problems.end());
      }
      if (key == std::string_view("initial.grains") && loaded.sizes.empty()) {
        loaded.sizes = start->sizes;
      }
    }
    report(validate(loaded.config, loaded.sizes), reading);
  }
  loaded.problems = std::move(reading.problems());
  sort_by_line(loaded.problems);
  loaded.problems.insert(loaded.problems.end(), from_starts.begin(), from_starts.end());
  return loaded;
}

/// Throws if there is any problem.
Loaded checked(Loaded loaded) {
  if (loaded.problems.empty()) return loaded;
  constexpr std::size_t most_told = 30;  // of what is no case at all there may be any number
  const std::size_t count = loaded.problems.size();
  std::vector<std::string> lines;
  for (const Problem& problem : loaded.problems) {
    if (lines.size() == most_told) break;
    lines.push_back(printable(fmt::format("{}: {}", to_string(problem.where), problem.text)));
  }
  if (count > lines.size()) lines.push_back(fmt::format("  ... and {} more", count - lines.size()));
  lines.push_back(fmt::format("{} problem{}; nothing was run.", count, count == 1 ? "" : "s"));
  throw ConfigError(std::move(lines));
}

Loaded load_file(const fs::path& file, const std::vector<std::string>& overrides) {
  Loaded nothing;
  const auto text = read_text(file, nothing.problems);
  return checked(text ? load(*text, file, overrides, {}) : nothing);
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> lines)
    : InputError(fmt::format("{}", fmt::join(lines, "\n"))), lines_(std::move(lines)) {}

Config load_config(const fs::path& file, const std::vector<std::string>& overrides) {
  return load_file(file, overrides).config;
}

Config load_config_text(std::string_view text, const fs::path& file,
                        const std::vector<std::string>& overrides) {
  return checked(load(text, file, overrides, {})).config;
}

Config config_as_written(std::string_view resolved, const fs::path& file) {
  Reading reading(file.string());
  const Node tree = parse_toml(resolved, reading.file(), reading.problems());
  return read_tree(reading, tree, file);
}

std::vector<SizeClass> known_sizes(const Config& config) {
  if (!config.grains || !config.grains->sizes.empty()) {
    return config.grains ? config.grains->sizes : std::vector<SizeClass>{};
  }
  const fs::path start = config.initial.grains;
  if (start.extension() != ".toml") return {};
  return load_file(start, {}).sizes;
}

}  // namespace barchan
