#include "src/config/resolved.hpp"

#include <type_traits>

#include <fmt/format.h>

#include "src/config/names.hpp"
#include "src/config/toml_tree.hpp"

namespace barchan {
namespace {

std::string value_text(const std::string& value) { return toml_quoted(value); }

template <class T>
std::string value_text(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return toml_quoted(choice_name(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return toml_number(value);
  } else {
    return fmt::format("{}", value);  // integers, true, false
  }
}

template <class T, std::size_t N>
std::string value_text(const std::array<T, N>& values) {
  std::string text;
  for (const T& value : values) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", value_text(value));
  }
  return "[" + text + "]";
}

std::string value_text(const std::vector<SizeClass>& sizes) {
  std::string text;
  for (const SizeClass& size : sizes) {
    text +=
        fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", toml_number(size.diameter), size.count);
  }
  return "[" + text + "]";
}

std::string value_text(const ForceSwitches& forces) {
  std::string text;
  for (const ForceName& force : force_names) {
    if (forces.*force.on) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", force.name);
  }
  return "[" + text + "]";
}

/// Lines of one section.
class Writer {
 public:
  explicit Writer(std::string& text) : text_(text) {}
  void section(const char* name) {
    text_ += fmt::format("{}[{}]\n", text_.empty() ? "" : "\n", name);
  }
  template <class T>
  void key(const char* name, const T& value) {
    text_ += fmt::format("{} = {}\n", name, value_text(value));
  }

 private:
  std::string& text_;
};

void write(Writer& w, const TimeConfig& c) {
  w.section("time");
  w.key("end", c.end);
  w.key("fluid_step", c.fluid_step);
  w.key("grain_step", c.grain_step);
  w.key("wall_clock_limit", c.wall_clock_limit);
}

void write(Writer& w, const FluidConfig& c) {
  w.section("fluid");
  w.key("cells", c.cells);
  w.key("first_cell_height", c.first_cell_height);
  w.key("density", c.density);
  w.key("kinematic_viscosity", c.kinematic_viscosity);
  w.key("mean_velocity", c.mean_velocity);
  if (c.pressure_gradient) w.key("pressure_gradient", *c.pressure_gradient);
  w.key("ramp_time", c.ramp_time);
  w.key("turbulence", c.turbulence);
  w.key("wale_constant", c.wale_constant);
  w.key("bottom", c.bottom);
  w.key("top", c.top);
  w.key("top_velocity", c.top_velocity);
}

void write(Writer& w, const Material& c) {
  w.key("youngs_modulus", c.youngs_modulus);
  w.key("poisson_ratio", c.poisson_ratio);
  w.key("restitution", c.restitution);
  w.key("sliding_friction", c.sliding_friction);
  w.key("rolling_friction", c.rolling_friction);
}

void write(Writer& w, const GrainConfig& c) {
  w.section("grains");
  w.key("density", c.density);
  write(w, c.material);
  w.key("coulomb_limit", c.coulomb_limit);
  w.key("rolling_model", c.rolling_model);
  w.key("rolling_theta_m", c.rolling_theta_m);
  w.key("contact_model", c.contact_model);
  w.key("linear_stiffness", c.linear_stiffness);
  w.key("sizes", c.sizes);
  w.key("frozen", c.frozen);
  w.key("boundary_x", c.boundary_x);
  w.key("boundary_z", c.boundary_z);
  w.key("gravity", c.gravity);
  w.key("skin", c.skin);
  w.key("max_overlap", c.max_overlap);
  w.section("grains.wall");
  write(w, c.wall);
  if (c.ambient) {
    w.section("grains.ambient");
    w.key("density", c.ambient->density);
    w.key("kinematic_viscosity", c.ambient->kinematic_viscosity);
  }
}

void write(Writer& w, const CouplingConfig& c) {
  w.section("coupling");
  w.key("drag", c.drag);
  w.key("void_fraction", c.void_fraction);
  w.key("smoothing_length", c.smoothing_length);
  w.key("alpha_time_derivative", c.alpha_time_derivative);
  w.key("relaxation", c.relaxation);
  w.key("forces", c.forces);
}

void write(Writer& w, const InitialConfig& c) {
  w.section("initial");
  w.key("fluid", c.fluid);
  if (!c.grains.empty()) w.key("grains", c.grains);
  w.key("seed", c.seed);
  if (!c.pour) return;
  w.section("initial.grains.pour");
  w.key("centre", c.pour->centre);
  w.key("radius", c.pour->radius);
  w.key("drop_height", c.pour->drop_height);
  w.key("seed", c.pour->seed);
}

void write(Writer& w, const OutputConfig& c) {
  w.section("output");
  w.key("history_interval", c.history_interval);
  w.key("dune_interval", c.dune_interval);
  w.key("grains_interval", c.grains_interval);
  w.key("fields_interval", c.fields_interval);
  w.key("tracks_interval", c.tracks_interval);
  w.key("grain_forces", c.grain_forces);
}

void write(Writer& w, const RestartConfig& c) {
  w.section("restart");
  w.key("interval", c.interval);
  w.key("wall_interval", c.wall_interval);
  w.key("keep", c.keep);
}

void write(Writer& w, const StatisticsConfig& c) {
  w.section("statistics");
  w.key("start", c.start);
  w.key("interval", c.interval);
  w.key("fields", c.fields);
  w.key("grain_forces", c.grain_forces);
}

void write(Writer& w, const SolverConfig& c) {
  w.section("solver");
  w.key("pressure_tolerance", c.pressure_tolerance);
  w.key("max_iterations", c.max_iterations);
  w.key("correctors", c.correctors);
  w.key("preconditioner", c.preconditioner);
}

}  // namespace

std::string to_toml(const Config& config) {
  std::string text;
  Writer w(text);
  w.section("case");
  w.key("title", config.title);
  write(w, config.time);
  w.section("domain");
  w.key("size", config.size);
  if (config.fluid) write(w, *config.fluid);
  if (config.grains) write(w, *config.grains);
  write(w, config.coupling);
  write(w, config.initial);
  write(w, config.output);
  write(w, config.restart);
  if (config.statistics) write(w, *config.statistics);
  write(w, config.solver);
  return text;
}

}  // namespace barchan
