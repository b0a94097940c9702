#include "src/config/validate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/ranges.h>

namespace barchan {
namespace {

void check_time(const Config& c, Findings& found) {
  constexpr double most_steps = 9'999'999'999;  // restart files have ten digits in their names
  found.error_if(c.time.end / c.time.fluid_step > most_steps, {"time.end", "time.fluid_step"},
                 "must be at most {:.3g} s, which is {:.0f} fluid steps; take an earlier end or a "
                 "longer time.fluid_step",
                 most_steps * c.time.fluid_step, most_steps);
  found.error_if(c.time.end < c.time.fluid_step, {"time.end", "time.fluid_step"},
                 "must be at least one fluid_step, {:.3g} s", c.time.fluid_step);
  const double ran = static_cast<double>(fluid_steps(c.time)) * c.time.fluid_step;
  found.warning_if(std::abs(ran - c.time.end) > 1e-6 * c.time.fluid_step + 1e-9 * c.time.end,
                   {"time.end", "time.fluid_step"},
                   "is not a whole number of fluid steps; the run ends at {:.6g} s", ran);
  if (!c.grains || c.grains->frozen) return;
  if (!found.error_if(c.time.grain_step > c.time.fluid_step, {"time.grain_step", "time.fluid_step"},
                      "must be at most fluid_step, {:.3g} s", c.time.fluid_step))
    found.error_if(c.time.fluid_step > 1e6 * c.time.grain_step,
                   {"time.grain_step", "time.fluid_step"},
                   "must be at least a millionth of fluid_step");
}

/// False when there is no mesh to speak of: one was asked for that cannot be, or what it rests on
/// could not be read (a complaint of its own).
bool check_mesh(const Config& c, Findings& found) {
  const auto positive = [](auto value) { return value > 0; };
  if (!std::all_of(c.fluid->cells.begin(), c.fluid->cells.end(), positive) ||
      !std::all_of(c.size.begin(), c.size.end(), positive)) {
    return false;
  }
  const int ny = c.fluid->cells[1];
  const double first = c.fluid->first_cell_height;
  const double uniform = c.size[1] / ny;
  const Keys keys{"fluid.first_cell_height", "fluid.cells", "domain.size"};
  if (found.error_if(
          first > uniform * (1 + 1e-9) || (ny == 1 && first > 0 && first < uniform * (1 - 1e-9)),
          keys,
          "must be at most Ly / ny = {:.4g} m: the rows grow from the floor upwards, or are "
          "all equal",
          uniform))
    return false;
  return true;
}

void check_steps(const Config& c, const FluidNumbers& n, Findings& found) {
  if (found.error_if(
          n.stretching > 2, {"fluid.first_cell_height", "fluid.cells", "domain.size"},
          "must be larger: rows would grow by {:.3g} each, of at most 2 (better 1.2); more "
          "rows help as well",
          n.stretching))
    return;
  found.warning_if(n.stretching > 1.2, {"fluid.first_cell_height", "fluid.cells"},
                   "makes rows grow by {:.3f} each; above 1.2 is coarse", n.stretching);
  const Keys keys{"time.fluid_step", "fluid.cells", "fluid.mean_velocity", "domain.size"};
  if (!found.error_if(
          n.cfl > 1, keys,
          "must keep the CFL number below 1; the mean flow alone has {:.2f} at the centreline",
          n.cfl))
    found.warning_if(
        n.cfl > 0.5, keys,
        "gives a CFL number of {:.2f} for the mean flow alone; fluctuations come on top, "
        "keep below 0.5",
        n.cfl);
  const Keys viscous{"time.fluid_step", "fluid.cells", "fluid.kinematic_viscosity", "domain.size"};
  if (!found.error_if(
          n.viscous_number > 1, viscous,
          "must be at most {:.3g} s: viscosity is explicit and the smallest cell sets the limit",
          c.time.fluid_step / n.viscous_number))
    found.warning_if(n.viscous_number > 0.5, viscous,
                     "is over half of the viscous limit; eddy viscosity comes on top");
}

void check_fluid(const Config& c, Findings& found) {
  const FluidConfig& fluid = *c.fluid;
  const bool held = fluid.mean_velocity > 0;
  const bool driven = held || fluid.pressure_gradient.value_or(0) != 0;
  found.error_if(fluid.pressure_gradient && held,
                 {"fluid.pressure_gradient", "fluid.mean_velocity"},
                 "contradicts mean_velocity: give one of the two");
  found.error_if(fluid.top_velocity != 0 && fluid.top != WallFlow::no_slip,
                 {"fluid.top_velocity", "fluid.top"}, "must come with top = \"no_slip\"");
  if (!found.error_if(fluid.ramp_time > 0 && !held, {"fluid.ramp_time", "fluid.mean_velocity"},
                      "must be absent without a mean_velocity to bring up"))
    found.warning_if(fluid.ramp_time > c.time.end, {"fluid.ramp_time", "time.end"},
                     "is longer than the run");
  found.error_if(c.initial.fluid == "turbulent" && !driven,
                 {"initial.fluid", "fluid.mean_velocity", "fluid.pressure_gradient"},
                 "must come with a mean_velocity or pressure_gradient, which sets its log law");
  found.error_if(c.initial.fluid == "turbulent" && fluid.kinematic_viscosity == 0,
                 {"initial.fluid", "fluid.kinematic_viscosity"}, "must come with a viscosity");
  if (check_mesh(c, found)) check_steps(c, *derive(c, {}).fluid, found);
}

/// Of the lattice that a cone of these grains is cut from.
double spacing_of_cone(const std::vector<SizeClass>& sizes) {
  double widest = 0;
  for (const SizeClass& size : sizes) widest = std::max(widest, size.diameter);
  return 1.01 * widest;
}

void check_pour(const Config& c, Findings& found) {
  const PourConfig& pour = *c.initial.pour;
  found.error_if(c.grains->sizes.empty(), {"grains.sizes", "initial.grains"},
                 "must say which grains to pour");
  found.error_if(c.grains->frozen, {"grains.frozen", "initial.grains"},
                 "contradicts pour: grains could not settle");
  for (const int axis : {0, 1}) {
    const double extent = c.size[axis == 0 ? 0 : 2];
    const double at = pour.centre[static_cast<std::size_t>(axis)];
    found.error_if(at - pour.radius < 0 || at + pour.radius > extent,
                   {"initial.grains.pour.radius", "initial.grains.pour.centre", "domain.size"},
                   "must keep the cone inside the domain; along {} it spans {:.4g} to {:.4g} m of "
                   "0 to {:.4g} m",
                   axis == 0 ? 'x' : 'z', at - pour.radius, at + pour.radius, extent);
  }
  if (spacing_of_cone(c.grains->sizes) >= c.size[1]) return;  // told by check_grain_sizes
  // The cone is cut from a close-packed lattice one per cent wider than the largest grain.
  const double spacing = spacing_of_cone(c.grains->sizes);
  double count = 0;
  for (const SizeClass& size : c.grains->sizes) count += static_cast<double>(size.count);
  const double volume = count * std::pow(spacing, 3) / std::numbers::sqrt2;
  const double height = 3 * volume / (std::numbers::pi * pour.radius * pour.radius);
  found.error_if(height + pour.drop_height > c.size[1],
                 {"initial.grains.pour.radius", "initial.grains.pour.drop_height", "domain.size"},
                 "must be larger: the cone would reach about {:.3g} m, above the domain",
                 height + pour.drop_height);
}

void check_initial(const Config& c, Findings& found) {
  found.error_if(!c.fluid && c.initial.fluid != "still", {"initial.fluid", "fluid"},
                 "must be absent without a [fluid] section");
  const bool given = c.initial.pour.has_value() || !c.initial.grains.empty();
  found.error_if(!c.grains && given, {"initial.grains", "grains"},
                 "must be absent without a [grains] section");
  found.error_if(c.grains && !given, {"initial.grains", "initial.grains.pour"},
                 "must say where the [grains] start: a file or {{ pour = {{...}} }}");
  if (c.grains && c.initial.pour) check_pour(c, found);
}

void check_output(const Config& c, Findings& found) {
  const auto check = [&](const char* key, double interval) {
    found.warning_if(interval > 0 && interval < c.time.fluid_step * (1 - 1e-9), {key},
                     "is shorter than a fluid step; written after every step");
  };
  check("output.history_interval", c.output.history_interval);
  check("output.dune_interval", c.output.dune_interval);
  check("output.grains_interval", c.output.grains_interval);
  check("output.fields_interval", c.output.fields_interval);
  check("output.tracks_interval", c.output.tracks_interval);
}

void check_statistics(const Config& c, Findings& found) {
  if (!c.statistics) return;
  found.error_if(!c.fluid, {"statistics.start", "fluid"},
                 "must be absent without a [fluid] section");
  found.error_if(c.statistics->grain_forces && !c.grains, {"statistics.grain_forces", "grains"},
                 "must be absent without a [grains] section");
  found.error_if(c.statistics->start >= c.time.end, {"statistics.start", "time.end"},
                 "must be before the end, {:.6g} s", c.time.end);
}

void check_smoothing(const Config& c, const FluidNumbers& flow, double d_mean, Findings& found) {
  const double smallest = std::min({flow.dx, flow.dy_first, flow.dz});
  const double length = c.coupling.smoothing_length;
  found.warning_if(length == 0 && smallest < 2 * d_mean,
                   {"coupling.smoothing_length", "fluid.cells"},
                   "is off; with cells below two grain diameters alpha_f is then noisy");
  if (!found.warning_if(length > 0 && length < 0.25 * smallest,
                        {"coupling.smoothing_length", "fluid.cells"},
                        "is under a quarter of the smallest cell, {:.3g} m: no effect", smallest))
    found.warning_if(length > 0.25 * c.size[1], {"coupling.smoothing_length", "domain.size"},
                     "is over a quarter of the height: it would smear the dune away");
}

bool has_mesh(const Config& c) {
  Findings ignored;
  return !c.fluid || check_mesh(c, ignored);
}

}  // namespace

std::vector<Finding> check_grain_sizes(const Config& c, const std::vector<SizeClass>& sizes) {
  Findings found;
  if (!c.grains || sizes.empty() || !has_mesh(c)) return {};
  const Derived derived = derive(c, sizes);
  const GrainNumbers& n = *derived.grains;
  const double narrowest = *std::min_element(c.size.begin(), c.size.end());
  if (found.error_if(
          narrowest > 0 && n.d_max >= narrowest, {"grains.sizes", "domain.size"},
          "holds a diameter of {:.4g} m, wider than the domain, {:.4g} m; lengths are in m: "
          "0.2 mm is 2e-4",
          n.d_max, narrowest))
    return found.all;
  check_grain_step(c, n, found);
  found.warning_if(c.grains->skin > n.d_min, {"grains.skin", "grains.sizes"},
                   "is above the smallest diameter: needlessly long neighbour lists");
  // The neighbour search looks at the columns on either side, which must be three different ones.
  const double reach = 3 * (n.d_max + c.grains->skin);
  found.error_if(
      (c.grains->boundary_z == GrainBoundaryZ::periodic && c.size[2] < reach) ||
          (c.grains->boundary_x == GrainBoundaryX::periodic && c.size[0] < reach),
      {"domain.size", "grains.sizes", "grains.skin"},
      "must be at least {:.3g} m in a periodic direction: a grain would meet its own image", reach);
  if (!c.fluid) return found.all;
  found.warning_if(
      n.cell_ratio < 1.2 || n.cell_ratio > 1.6,
      {"fluid.cells", "fluid.first_cell_height", "grains.sizes", "domain.size"},
      "makes the smallest cell {:.2f} mean grain diameters; the paper recommends 1.2 to 1.6",
      n.cell_ratio);
  check_smoothing(c, *derived.fluid, n.d_mean, found);
  return found.all;
}

std::vector<Finding> check_start(const Config& c, const Config& start, bool flow) {
  Findings found;
  const std::string key = flow ? "initial.fluid" : "initial.grains";
  found.error_if(flow && !start.fluid, {key}, "must be a case with [fluid]");
  found.error_if(!flow && !start.grains, {key}, "must be a case with [grains]");
  if (!flow || !c.fluid || !start.fluid) return found.all;
  found.error_if(start.size != c.size, {key, "domain.size"},
                 "must have the same domain; its size is [{}] m", fmt::join(start.size, ", "));
  found.error_if(start.fluid->cells != c.fluid->cells ||
                     start.fluid->first_cell_height != c.fluid->first_cell_height,
                 {key, "fluid.cells", "fluid.first_cell_height"},
                 "must have the same mesh; its cells are [{}] from {:.4g} m",
                 fmt::join(start.fluid->cells, ", "), start.fluid->first_cell_height);
  return found.all;
}

std::vector<Finding> validate(const Config& c, const std::vector<SizeClass>& sizes) {
  Findings found;
  check_time(c, found);
  if (found.error_if(!c.fluid && !c.grains, {"fluid", "grains"},
                     "required, or [grains]: without both there is nothing to run"))
    return found.all;
  if (c.fluid) check_fluid(c, found);
  if (c.grains) check_grains(c, found);
  check_initial(c, found);
  check_output(c, found);
  check_statistics(c, found);
  const std::vector<Finding> of_sizes = check_grain_sizes(c, sizes);
  found.all.insert(found.all.end(), of_sizes.begin(), of_sizes.end());
  return found.all;
}

std::vector<std::string> config_warnings(const Config& config,
                                         const std::vector<SizeClass>& sizes) {
  std::vector<std::string> lines;
  for (const Finding& finding : validate(config, sizes)) {
    if (finding.severity != Finding::Severity::warning) continue;
    const std::string& key = finding.keys.front();
    const std::size_t dot = key.rfind('.');
    lines.push_back(fmt::format("warning: [{}] {} {}", key.substr(0, dot), key.substr(dot + 1),
                                finding.message));
  }
  return lines;
}

}  // namespace barchan
