#include "src/config/keys.hpp"

#include "src/config/key_builder.hpp"

namespace barchan {
namespace {

using enum Rule;

/// An optional section is there when the file has it, with its defaults.
template <class T>
auto optional_section(std::optional<T> Config::*member) {
  return [member](Config& c, bool in_file) {
    if (in_file) (c.*member).emplace();
  };
}

Section of_case() {
  Section section{.name = "case", .meaning = "What the run is called"};
  Keys key(section, [](auto& c) { return &c; });
  key("title", &Config::title, at_most(200), "", "a line for tables, pages and pictures");
  key("notes", &Config::notes, at_most(2000), "", "who ran it and why: kept with every result");
  return section;
}

Section of_time() {
  Section section{.name = "time", .meaning = "End and steps", .required = true};
  Keys key(section, [](auto& c) { return &c.time; });
  key("end", &TimeConfig::end, above(0), "s", "time at which the run ends", required);
  key("fluid_step", &TimeConfig::fluid_step, above(0).at_most(1).plausible(1e-15, 1), "s",
      "step of the flow; without `[fluid]` the interval between checks and output",
      fixed_by_restart);
  key("grain_step", &TimeConfig::grain_step, above(0).at_most(1).plausible(1e-18, 1), "s",
      "longest step of the grains: a fluid step is cut into equal ones");
  key("wall_clock_limit", &TimeConfig::wall_clock_limit, at_least(0), "s",
      "wall time after which a restart file is written and the run stops (exit code 3); 0: none");
  return section;
}

Section of_domain() {
  Section section{.name = "domain", .meaning = "The box", .required = true};
  Keys key(section, [](auto& c) { return &c; });
  key("size", &Config::size, above(0).plausible(1e-9, 1e6), "m",
      "[Lx, Ly, Lz]: along the stream, upwards, across", required_and_fixed);
  return section;
}

Section of_fluid() {
  Section section{.name = "fluid",
                  .meaning = "The flow; without the section grains move alone",
                  .prepare = optional_section(&Config::fluid)};
  Keys key(section, [](auto& c) { return if_there(c.fluid); });
  using F = FluidConfig;
  key("cells", &F::cells, at_least(1).at_most(100000), "", "[nx, ny, nz]", required_and_fixed);
  key("first_cell_height", &F::first_cell_height, at_least(0), "m",
      "height of the lowest row, from which rows grow by a constant ratio; 0: all are equal",
      fixed_by_restart);
  key("density", &F::density, above(0).plausible(1e-6, 1e9), "kg/m3", "density of the fluid");
  key("kinematic_viscosity", &F::kinematic_viscosity, at_least(0).plausible(0, 1e6), "m2/s",
      "its viscosity over its density");
  key("mean_velocity", &F::mean_velocity, at_least(0).plausible(0, 1e6), "m/s",
      "bulk velocity along x, held by a body force");
  key("pressure_gradient", &F::pressure_gradient, any.plausible(0, 1e12), "Pa/m",
      "driving force along x per volume, instead of `mean_velocity`");
  key("ramp_time", &F::ramp_time, at_least(0), "s",
      "time over which `mean_velocity` is brought up from its start");
  key("turbulence", &F::turbulence, any, "", "subgrid model");
  key("wale_constant", &F::wale_constant, at_least(0).at_most(2), "", "constant of the WALE model");
  key("bottom", &F::bottom, any, "", "what the floor is to the flow");
  key("top", &F::top, any, "", "what the top is to the flow");
  key("top_velocity", &F::top_velocity, any.plausible(0, 1e6), "m/s",
      "velocity along x of a no-slip top: a lid that drags the flow");
  return section;
}

/// In [grains] and again in [grains.wall].
template <class Get>
void add_material(Section& section, Get get) {
  Keys key(section, get);
  using M = Material;
  key("youngs_modulus", &M::youngs_modulus, above(0).plausible(1e-3, 1e30), "Pa",
      "Young's modulus");
  key("poisson_ratio", &M::poisson_ratio, at_least(0).at_most(0.5), "", "Poisson's ratio");
  key("restitution", &M::restitution, above(0).at_most(1), "", "coefficient of restitution");
  key("sliding_friction", &M::sliding_friction, at_least(0).plausible(0, 1e6), "",
      "coefficient of sliding friction");
  key("rolling_friction", &M::rolling_friction, at_least(0).plausible(0, 1e6), "",
      "coefficient of rolling friction");
}

Section of_grains() {
  Section section{.name = "grains",
                  .meaning = "The grains; without the section water flows alone",
                  .prepare = optional_section(&Config::grains)};
  Keys key(section, [](auto& c) { return if_there(c.grains); });
  using G = GrainConfig;
  key("density", &G::density, above(0).plausible(1e-6, 1e9), "kg/m3", "density of the grains",
      fixed_by_restart);
  add_material(section, [](auto& c) { return c.grains ? &c.grains->material : nullptr; });
  key("coulomb_limit", &G::coulomb_limit, any, "",
      "the normal force that limits friction: with its damping, or its elastic part");
  key("rolling_model", &G::rolling_model, any, "", "model of the resistance to rolling");
  key("rolling_theta_m", &G::rolling_theta_m, above(0).plausible(1e-9, 1e6), "rad",
      "angle of incipient rolling of the model \"theta_m\"");
  key("contact_model", &G::contact_model, any, "", "law of the forces in a contact");
  key("linear_stiffness", &G::linear_stiffness, at_least(0).plausible(0, 1e30), "N/m",
      "stiffness of `contact_model` \"linear\", which requires it");
  key("sizes", &G::sizes, any.plausible(1e-9, 1e6), "m",
      "[[diameter, count], ...] of the grains to pour; else the initial file decides");
  key("frozen", &G::frozen, any, "", "grains hold still and the flow feels them");
  key("boundary_x", &G::boundary_x, any, "", "what happens to grains at both ends in x",
      fixed_by_restart);
  key("boundary_z", &G::boundary_z, any, "", "what happens to grains at both sides in z",
      fixed_by_restart);
  key("gravity", &G::gravity, any.plausible(0, 1e6), "m/s2", "acceleration of gravity");
  key("skin", &G::skin, at_least(0).plausible(0, 1e3), "m",
      "margin of the neighbour lists, which last until a grain has moved half of it");
  key("max_overlap", &G::max_overlap, above(0).at_most(1), "",
      "overlap that stops the run, over the mean diameter of a pair or of a grain in a wall");
  return section;
}

Section of_wall() {
  Section section{.name = "grains.wall",
                  .meaning = "Material of the walls; what is not given is as in `[grains]`",
                  .prepare = [](Config& c, bool) {
                    if (c.grains) c.grains->wall = c.grains->material;
                  }};
  add_material(section, [](auto& c) { return c.grains ? &c.grains->wall : nullptr; });
  return section;
}

Section of_ambient() {
  Section section{.name = "grains.ambient",
                  .meaning =
                      "Still fluid around the grains of a case without `[fluid]`; "
                      "without the section a vacuum",
                  .prepare = [](Config& c, bool in_file) {
                    if (in_file) c.grains->ambient.emplace();
                  }};
  Keys key(section, [](auto& c) { return c.grains ? if_there(c.grains->ambient) : nullptr; });
  key("density", &AmbientConfig::density, above(0).plausible(1e-6, 1e9), "kg/m3",
      "density of the fluid");
  key("kinematic_viscosity", &AmbientConfig::kinematic_viscosity, above(0).plausible(1e-15, 1e6),
      "m2/s", "its viscosity over its density");
  return section;
}

Section of_coupling() {
  Section section{.name = "coupling", .meaning = "Forces between grains and flow"};
  Keys key(section, [](auto& c) { return &c.coupling; });
  using C = CouplingConfig;
  key("drag", &C::drag, any, "", "drag law");
  key("void_fraction", &C::void_fraction, any, "",
      "how the volume of a grain is given to the cells around it");
  key("smoothing_length", &C::smoothing_length, at_least(0).plausible(0, 1e6), "m",
      "width over which void fraction and exchanged forces are smoothed (3 d in the paper); 0: "
      "not");
  key("alpha_time_derivative", &C::alpha_time_derivative, any, "",
      "the flow feels changes of the void fraction in time");
  key("relaxation", &C::relaxation, any, "",
      "exchange in dense beds is relaxed; false is unstable there, for comparison");
  key("forces", &C::forces, any, "", "the forces of the flow on the grains");
  return section;
}

Section of_initial() {
  Section section{.name = "initial", .meaning = "The state at t = 0"};
  Keys key(section, [](auto& c) { return &c.initial; });
  using I = InitialConfig;
  key("fluid", &I::fluid, any, "",
      "\"still\", \"turbulent\" (a log law with perturbations), a restart file `.h5`, or the end "
      "of a case `.toml`");
  key("grains", &I::grains, any, "",
      "a table `.csv`, a `.h5`, the end of a case `.toml`, or `{ pour = {...} }`");
  key("seed", &I::seed, any, "", "of the perturbations of \"turbulent\"");
  return section;
}

Section of_pour() {
  Section section{.name = "initial.grains.pour",
                  .meaning = "A loose cone of the grains of `grains.sizes`, which settles",
                  .prepare = [](Config& c, bool in_file) {
                    if (in_file) c.initial.pour.emplace();
                  }};
  Keys key(section, [](auto& c) { return if_there(c.initial.pour); });
  using P = PourConfig;
  key("centre", &P::centre, any, "m", "[x, z] of its axis");
  key("radius", &P::radius, above(0).plausible(1e-9, 1e6), "m", "of its foot", required);
  key("drop_height", &P::drop_height, at_least(0).plausible(0, 1e6), "m",
      "of its lowest grain above the floor");
  key("seed", &P::seed, any, "", "of the order and the jitter of the grains");
  return section;
}

Section of_output() {
  Section section{.name = "output", .meaning = "Intervals in simulated time; 0: no such file"};
  Keys key(section, [](auto& c) { return &c.output; });
  using O = OutputConfig;
  key("history_interval", &O::history_interval, at_least(0), "s", "of `history.csv`");
  key("dune_interval", &O::dune_interval, at_least(0), "s", "of `dune.csv`");
  key("grains_interval", &O::grains_interval, at_least(0), "s", "of `grains.h5`");
  key("fields_interval", &O::fields_interval, at_least(0), "s", "of `fields.h5`");
  key("tracks_interval", &O::tracks_interval, at_least(0), "s",
      "of `tracks.h5`: numbers and positions of the grains alone");
  key("grain_forces", &O::grain_forces, any, "", "each force separately in `grains.h5`");
  return section;
}

Section of_restart() {
  Section section{.name = "restart", .meaning = "Restart files, from which a run can go on"};
  Keys key(section, [](auto& c) { return &c.restart; });
  key("interval", &RestartConfig::interval, at_least(0), "s", "in simulated time; 0: none");
  key("wall_interval", &RestartConfig::wall_interval, at_least(0), "s", "in wall time; 0: none");
  key("keep", &RestartConfig::keep, at_least(1).at_most(1000), "", "how many are kept");
  return section;
}

Section of_statistics() {
  Section section{.name = "statistics",
                  .meaning = "Averages over time; none without the section",
                  .prepare = optional_section(&Config::statistics)};
  Keys key(section, [](auto& c) { return if_there(c.statistics); });
  using S = StatisticsConfig;
  key("start", &S::start, at_least(0), "s", "time of the first sample", required);
  key("interval", &S::interval, above(0), "s", "between samples");
  key("fields", &S::fields, any, "", "means and second moments in every cell, `flow_average.h5`");
  key("grain_forces", &S::grain_forces, any, "",
      "resultant force on the grains around the largest dune, `force_map.csv`");
  return section;
}

Section of_solver() {
  Section section{.name = "solver", .meaning = "The equation of the pressure"};
  Keys key(section, [](auto& c) { return &c.solver; });
  using S = SolverConfig;
  key("pressure_tolerance", &S::pressure_tolerance, above(0).below(1), "",
      "residual over right-hand side (2-norms) at which iterations stop");
  key("max_iterations", &S::max_iterations, at_least(1), "", "of the conjugate gradients a step");
  key("preconditioner", &S::preconditioner, any, "",
      "a solve by FFT; \"local_fft\" adds a relaxation where grains hinder the flow");
  return section;
}

struct Removed {
  std::string_view key, value, why;  // no value: the key as a whole
};
constexpr Removed removed[] = {
    {"solver.correctors", "", "one correction of the pressure a step is exact; delete this line"},
    {"solver.preconditioner", "\"jacobi\"", "take \"local_fft\", the default, or \"fft\""},
    {"solver.preconditioner", "\"none\"", "take \"local_fft\", the default, or \"fft\""}};

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      of_case(),
      of_time(),
      of_domain(),
      of_fluid(),
      of_grains(),
      of_wall(),
      of_ambient(),
      of_coupling(),
      of_initial(),
      // A table only to hold the next one: initial.grains is a key otherwise.
      {.name = "initial.grains", .meaning = ""},
      of_pour(),
      of_output(),
      of_restart(),
      of_statistics(),
      of_solver()};
  return all;
}

std::string removal(std::string_view dotted, std::string_view value) {
  for (const Removed& one : removed) {
    if (one.key != dotted || one.value != value) continue;
    return fmt::format("was removed after version 0.1.0: {}", one.why);
  }
  return {};
}

}  // namespace barchan
