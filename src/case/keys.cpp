#include "src/toml/keys.hpp"

#include "src/case/body_keys.hpp"
#include "src/case/case_keys.hpp"
#include "src/case/case_values.hpp"
#include "src/case/coupling_keys.hpp"
#include "src/case/material_keys.hpp"
#include "src/case/output_keys.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {
namespace {

void add_domain(Sections& all) {
  Keys key(add(all, "domain", "The box"), [](auto& c) { return &c; });
  key("size", &Config::size, between(1e-9, 1e6), "m",
      "[Lx, Ly, Lz]: along the stream, upwards, across", required_and_fixed);
}

void add_fluid(Sections& all) {
  Keys key(add(all, "fluid", "The flow; without the section grains move alone"),
           [](auto& c) { return &c.fluid; });
  using F = FluidConfig;
  key("cells", &F::cells, between(1, 100000), "", "[nx, ny, nz]", required_and_fixed);
  key("first_cell_height", &F::first_cell_height, between(0, 1e6), "m",
      "height of the lowest layer of cells; layers above grow by a constant ratio; 0: equal layers",
      fixed_by_restart);
  key("uniform_height", &F::uniform_height, between(0, 1e6), "m",
      "layers are as high as the lowest one up to here; choose the height of the dune",
      fixed_by_restart);
  key("density", &F::density, between(1e-6, 1e9), "kg/m3", "density of the fluid");
  key("kinematic_viscosity", &F::kinematic_viscosity, between(0, 1e6), "m2/s",
      "kinematic viscosity of the fluid");
  key("mean_velocity", &F::mean_velocity, between(-1e6, 1e6), "m/s",
      "bulk velocity along x, or [along x, along z], kept constant by a body force");
  key("pressure_gradient", &F::pressure_gradient, between(-1e12, 1e12), "Pa/m",
      "driving force along x per volume, instead of `mean_velocity`");
  key("ramp_time", &F::ramp_time, at_least(0), "s",
      "time over which the bulk velocity rises linearly from its initial value to `mean_velocity`");
  key("turbulence", &F::turbulence, "subgrid model");
  key("wale_constant", &F::wale_constant, between(0, 2), "", "constant of the WALE model");
  key("bottom", &F::bottom, "boundary condition of the flow at the floor");
  key("top", &F::top, "boundary condition of the flow at the top");
  key("top_velocity", &F::top_velocity, between(-1e6, 1e6), "m/s",
      "velocity along x of a no-slip top: a lid that drags the flow");
}

void add_schedule(Sections& all) {
  Section& section = all.emplace_back(Section{
      "fluid.schedule",
      "Bulk velocities in order of time, instead of `mean_velocity`; the first from `time` 0 on"});
  auto key = repeated_keys(section, [](auto& c) { return c.fluid ? &c.fluid->schedule : nullptr; });
  using T = FlowTarget;
  key("time", &T::time, between(0, 1e12), "s", "time from which the entry holds", required);
  key("velocity", &T::velocity, between(-1e6, 1e6), "m/s",
      "bulk velocity along x, or [along x, along z], kept constant by a body force", required);
  key("ramp", &T::ramp, between(0, 1e12), "s",
      "time of a linear change to the new velocity (first entry: from the initial state)");
  key("amplitude", &T::amplitude, between(-1e6, 1e6), "m/s",
      "amplitude of a sine that is added from `time` on, number or [along x, along z]");
  key("period", &T::period, between(0, 1e12), "s", "period of the sine; required with `amplitude`");
}

void add_grains(Sections& all) {
  Keys key(add(all, "grains", "The grains; without the section water flows alone"),
           [](auto& c) { return &c.grains; });
  using G = GrainConfig;
  key("density", &G::density, between(1e-6, 1e9), "kg/m3", "density of the grains",
      fixed_by_restart);
  add_material(all.back(), [](auto& c) { return c.grains ? &c.grains->material : nullptr; });
  add_shape(all.back(), [](auto& c) { return c.grains ? &c.grains->shape : nullptr; });
  key("coulomb_limit", &G::coulomb_limit,
      "normal force in the Coulomb limit: the total one, or its elastic part");
  key("rolling_model", &G::rolling_model, "model of the resistance to rolling");
  key("rolling_theta_m", &G::rolling_theta_m, between(1e-9, 1e6), "rad",
      "angle of incipient rolling of the model \"theta_m\"");
  key("contact_model", &G::contact_model, "law of the forces in a contact");
  key("tangential_damping", &G::tangential_damping, between(0, 1), "",
      "factor on the dashpots along contacts, which limit the grain step; 0: none, as LIGGGHTS "
      "with "
      "tangential_damping off");
  key("thinnest_film", &G::thinnest_film, between(1e-6, 0.5), "",
      "gap over the radius below which the film of \"hertz_lubricated\" gets no stiffer: that of "
      "rough surfaces");
  key("linear_stiffness", &G::linear_stiffness, between(0, 1e30), "N/m",
      "spring stiffness; required with `contact_model` \"linear\"");
  key("sizes", &G::sizes, between(1e-9, 1e6), "m",
      "[[diameter, count], ...] of the grains to pour; without it the initial file has the grains");
  key("frozen", &G::frozen, "grains do not move; the flow feels them");
  key("boundary_x", &G::boundary_x,
      "boundary for grains at both ends in x; \"follow\": periodic, and grains are removed half a "
      "box "
      "away from the largest dune",
      fixed_by_restart);
  key("boundary_z", &G::boundary_z, "boundary for grains at both sides in z", fixed_by_restart);
  key("floor", &G::floor, "floor for grains: smooth, or a dense layer of glued spheres",
      fixed_by_restart);
  key("floor_diameter", &G::floor_diameter, between(0, 1e6), "m",
      "diameter of the glued spheres; required with `floor` \"glued\"", fixed_by_restart);
  key("gravity", &G::gravity, between(-1e6, 1e6), "m/s2", "acceleration of gravity");
  key("skin", &G::skin, between(0, 1e3), "m",
      "Verlet skin of grains at rest: a neighbour list is rebuilt when one has moved skin/2 (fast "
      "grains have a larger skin)")
      .by_default = "0.2 d";
  key("max_overlap", &G::max_overlap, above(0).at_most(1), "",
      "largest overlap before the run stops, over the mean diameter of the pair (at a wall: the "
      "grain); of clumps: of their spheres");
}

void add_ambient(Sections& all) {
  Keys key(add(all, "grains.ambient",
               "Still fluid around the grains of a case without `[fluid]`; "
               "without the section a vacuum"),
           [](auto& c) { return c.grains ? &c.grains->ambient : nullptr; });
  key("density", &AmbientConfig::density, between(1e-6, 1e9), "kg/m3", "density of the fluid");
  key("kinematic_viscosity", &AmbientConfig::kinematic_viscosity, between(1e-15, 1e6), "m2/s",
      "kinematic viscosity of the fluid");
}

void add_feed(Sections& all) {
  Keys key(
      add(all, "grains.feed", "Grains that enter at rest during the run; none without the section"),
      [](auto& c) { return c.grains ? &c.grains->feed : nullptr; });
  using F = FeedConfig;
  key("amount", &F::amount,
      "\"given\": at `rate`, with the size distribution of the initial grains; \"as_lost\": as "
      "many "
      "as leave, with their sizes");
  key("rate", &F::rate, between(0, 1e9), "1/s",
      "grains per second; required with `amount` \"given\"");
  key("start", &F::start, at_least(0), "s", "time from which grains enter, and losses count");
  key("x", &F::x, between(0, 1e6), "m",
      "x at which grains enter (upstream edge); with `boundary_x` \"follow\": distance from the "
      "edge "
      "of the window, half a box from the dune");
  key("across", &F::across, between(0, 1e6), "m",
      "[from, to] along z in which grains enter (centres); both 0: the whole width");
  key("height", &F::height, between(0, 1e6), "m",
      "height above the floor at which grains enter (lowest point)");
  key("seed", &F::seed, "random seed of places, orientations, and of sizes at a given rate");
}

void add_initial(Sections& all) {
  Keys key(add(all, "initial", "The state at t = 0"), [](auto& c) { return &c.initial; });
  using I = InitialConfig;
  key("fluid", &I::fluid,
      meaning_of<Choice<StartFlows>>(
          "a restart file `.h5`, or the end of a case `.toml`, from other cells of the same box "
          "interpolated; or a word")
          .c_str());
  key("grains", &I::grains,
      "a table `.csv`, a `.h5`, the end of a case `.toml`, or `{ pour = {...} }`");
  key("window", &I::window, any, "m",
      "[x, z]: place of this box in that of the cases of `fluid` and `grains`, of which it is a "
      "part");
  key("seed", &I::seed, "random seed of \"turbulent\", and of the orientations of clumps");
  key("realisation", &I::realisation, between(1, 1000000), "",
      "member of an ensemble: another packing, another turbulent flow");
}

/// Adds the keys that `pour` and [[initial.heap]] share; "": the default is that of the heap.
template <class AddKey>
void add_heap_keys(AddKey& key, const char* default_centre) {
  using H = HeapConfig;
  key("shape", &H::shape,
      "a cone, a ridge across the whole channel, or a bed of equal depth over the whole floor, on "
      "which the heaps after it stand");
  key("centre", &H::centre, any, "m", "[x, z] of the axis of a cone; of a ridge x alone counts")
      .by_default = default_centre;
  key("radius", &H::radius, between(0, 1e6), "m",
      "radius of the foot of a cone, half the width of a ridge; required for both");
  key("drop_height", &H::drop_height, between(0, 1e6), "m",
      "height of the lowest grain above the floor, or above the bed below the heap");
  key("spacing", &H::spacing, between(1, 10), "",
      "distance of grains as they are poured, over the closest; each is displaced at random within "
      "the gap. At 1 a bed keeps layers of the lattice; 1.25: a random bed");
  key("seed", &H::seed, "random seed of the order and the jitter of the grains");
}

void add_pour(Sections& all) {
  all.push_back({.name = "initial.grains"});  // to hold the next one: else a key
  Keys key(add(all, "initial.grains.pour",
               "One loose heap or bed of the grains of `sizes`, of all kinds in random order, "
               "which settles"),
           [](auto& c) { return &c.initial.pour; });
  add_heap_keys(key, "[Lx/5, Lz/2]");
}

void add_heaps(Sections& all) {
  Section& section = all.emplace_back(Section{
      .name = "initial.heap",
      .meaning = "Several heaps and beds instead of `pour`, poured in this order; each grain "
                 "keeps the number of its heap",
      .most = kMostHeaps});
  auto key = repeated_keys(section, [](auto& c) { return &c.initial.heaps; });
  using H = HeapConfig;
  key("name", &H::name, at_most(60), "", "name in result files and pictures");
  key("kind", &H::kind, "name of the `[[grains.kind]]` of the heap; without it all kinds");
  key("sizes", &H::sizes, between(1e-9, 1e6), "m",
      "[[diameter, count], ...] of the heap; without it those of the kind, or of `[grains]`");
  add_heap_keys(key, "");
}

void add_craters(Sections& all) {
  Section& section = all.emplace_back(Section{
      .name = "initial.crater",
      .meaning = "Hollows in the grains that the case starts from: each a paraboloid without "
                 "grains"});
  auto key = repeated_keys(section, [](auto& c) { return &c.initial.craters; });
  using C = CraterConfig;
  key("centre", &C::centre, any, "m", "[x, z] of the deepest point", required);
  key("radius", &C::radius, above(0).at_most(1e6), "m", "radius of the rim", required);
  key("depth", &C::depth, above(0).at_most(1e6), "m",
      "depth below the mean height of the surface within the rim", required);
}

void add_restart(Sections& all) {
  Keys key(add(all, "restart", "Restart files, from which a run can go on"),
           [](auto& c) { return &c.restart; });
  key("interval", &RestartConfig::interval, at_least(0), "s",
      "interval in simulated time; 0: none");
  key("wall_interval", &RestartConfig::wall_interval, at_least(0), "s",
      "interval in wall time; 0: none");
  key("keep", &RestartConfig::keep, between(1, 1000), "", "number of restart files that are kept");
}

void add_statistics(Sections& all) {
  Keys key(add(all, "statistics", "Averages over time; none without the section"),
           [](auto& c) { return &c.statistics; });
  using S = StatisticsConfig;
  key("start", &S::start, at_least(0), "s", "time of the first sample", required);
  key("interval", &S::interval, above(0), "s", "interval between samples");
  key("fields", &S::fields, "means and second moments in every cell, `flow_average.h5`");
  key("grain_forces", &S::grain_forces,
      "resultant force on the grains around the largest dune, `force_map.csv`");
  key("bed_load", &S::bed_load,
      "grains in layers, surface of the bed, stress and load there, `bedload.csv`");
}

void add_solver(Sections& all) {
  Keys key(add(all, "solver", "The equation of the pressure"), [](auto& c) { return &c.solver; });
  using S = SolverConfig;
  key("pressure_tolerance", &S::pressure_tolerance, at_least(1e-14).below(1), "",
      "residual over right-hand side (2-norms) at which iterations stop");
  key("max_iterations", &S::max_iterations, at_least(1), "",
      "largest number of iterations of the conjugate gradients in a step");
  key("preconditioner", &S::preconditioner, "preconditioner of the pressure equation");
}

}  // namespace

std::shared_ptr<Config> blank_config() { return std::make_shared<Config>(); }

const Sections& sections() {
  static const Sections all = [] {
    Sections made;
    for (auto* add :
         {add_case,     add_time,    add_domain,  add_fluid,   add_schedule,   add_grains,
          add_wall,     add_kinds,   add_pairs,   add_ambient, add_feed,       add_bodies,
          add_coupling, add_schemes, add_initial, add_pour,    add_heaps,      add_craters,
          add_output,   add_probes,  add_slices,  add_restart, add_statistics, add_solver}) {
      add(made);
    }
    return made;
  }();
  return all;
}

}  // namespace barchan
