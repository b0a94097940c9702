#include "src/config/validate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/config/derived.hpp"
#include "src/config/grain_checks.hpp"
#include "src/config/start.hpp"

namespace barchan {
namespace {

void check_time(const Config& c, Findings& found) {
  constexpr double most_steps = 9'999'999'999;  // restart files have ten digits in their names
  if (c.time.end / c.time.fluid_step > most_steps) {
    found.error({"time.end", "time.fluid_step"},
                fmt::format("must be at most {:.3g} s, which is {:.0f} fluid steps; take an "
                            "earlier end or a longer time.fluid_step",
                            most_steps * c.time.fluid_step, most_steps));
  }
  if (c.time.end < c.time.fluid_step) {
    found.error({"time.end", "time.fluid_step"},
                fmt::format("must be at least one fluid_step, {:.3g} s", c.time.fluid_step));
  }
  const double ran = static_cast<double>(fluid_steps(c.time)) * c.time.fluid_step;
  if (std::abs(ran - c.time.end) > 1e-6 * c.time.fluid_step + 1e-9 * c.time.end) {
    found.warning(
        {"time.end", "time.fluid_step"},
        fmt::format("is not a whole number of fluid steps; the run ends at {:.6g} s", ran));
  }
  if (!c.grains || c.grains->frozen) return;
  if (c.time.grain_step > c.time.fluid_step) {
    found.error({"time.grain_step", "time.fluid_step"},
                fmt::format("must be at most fluid_step, {:.3g} s", c.time.fluid_step));
  } else if (c.time.fluid_step > 1e6 * c.time.grain_step) {
    found.error({"time.grain_step", "time.fluid_step"},
                "must be at least a millionth of fluid_step");
  }
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
  if (first > uniform * (1 + 1e-9) || (ny == 1 && first > 0 && first < uniform * (1 - 1e-9))) {
    found.error(keys, fmt::format("must be at most Ly / ny = {:.4g} m: the rows grow from the "
                                  "floor upwards, or are all equal",
                                  uniform));
    return false;
  }
  return true;
}

void check_steps(const Config& c, const FluidNumbers& n, Findings& found) {
  if (n.stretching > 2) {
    found.error({"fluid.first_cell_height", "fluid.cells", "domain.size"},
                fmt::format("must be larger: rows would grow by {:.3g} each, of at most 2 (better "
                            "1.2); more rows help as well",
                            n.stretching));
    return;
  }
  if (n.stretching > 1.2) {
    found.warning({"fluid.first_cell_height", "fluid.cells"},
                  fmt::format("makes rows grow by {:.3f} each; above 1.2 is coarse", n.stretching));
  }
  const Keys keys{"time.fluid_step", "fluid.cells", "fluid.mean_velocity", "domain.size"};
  if (n.cfl > 1) {
    found.error(keys, fmt::format("must keep the CFL number below 1; the mean flow alone has "
                                  "{:.2f} at the centreline",
                                  n.cfl));
  } else if (n.cfl > 0.5) {
    found.warning(keys, fmt::format("gives a CFL number of {:.2f} for the mean flow alone; "
                                    "fluctuations come on top, keep below 0.5",
                                    n.cfl));
  }
  const Keys viscous{"time.fluid_step", "fluid.cells", "fluid.kinematic_viscosity", "domain.size"};
  if (n.viscous_number > 1) {
    found.error(viscous, fmt::format("must be at most {:.3g} s: viscosity is explicit and the "
                                     "smallest cell sets the limit",
                                     c.time.fluid_step / n.viscous_number));
  } else if (n.viscous_number > 0.5) {
    found.warning(viscous, "is over half of the viscous limit; eddy viscosity comes on top");
  }
}

void check_fluid(const Config& c, Findings& found) {
  const FluidConfig& fluid = *c.fluid;
  const bool held = fluid.mean_velocity > 0;
  const bool driven = held || fluid.pressure_gradient.value_or(0) != 0;
  if (fluid.pressure_gradient && held) {
    found.error({"fluid.pressure_gradient", "fluid.mean_velocity"},
                "contradicts mean_velocity: give one of the two");
  }
  if (fluid.top_velocity != 0 && fluid.top != WallFlow::no_slip) {
    found.error({"fluid.top_velocity", "fluid.top"}, "must come with top = \"no_slip\"");
  }
  if (fluid.ramp_time > 0 && !held) {
    found.error({"fluid.ramp_time", "fluid.mean_velocity"},
                "must be absent without a mean_velocity to bring up");
  } else if (fluid.ramp_time > c.time.end) {
    found.warning({"fluid.ramp_time", "time.end"}, "is longer than the run");
  }
  if (c.initial.fluid == "turbulent" && !driven) {
    found.error({"initial.fluid", "fluid.mean_velocity", "fluid.pressure_gradient"},
                "must come with a mean_velocity or pressure_gradient, which sets its log law");
  }
  if (c.initial.fluid == "turbulent" && fluid.kinematic_viscosity == 0) {
    found.error({"initial.fluid", "fluid.kinematic_viscosity"}, "must come with a viscosity");
  }
  if (check_mesh(c, found)) check_steps(c, *derive(c, {}).fluid, found);
}

void check_output(const Config& c, Findings& found) {
  const auto check = [&](const char* key, double interval) {
    if (interval > 0 && interval < c.time.fluid_step * (1 - 1e-9)) {
      found.warning({key}, "is shorter than a fluid step; written after every step");
    }
  };
  check("output.history_interval", c.output.history_interval);
  check("output.dune_interval", c.output.dune_interval);
  check("output.grains_interval", c.output.grains_interval);
  check("output.fields_interval", c.output.fields_interval);
  check("output.tracks_interval", c.output.tracks_interval);
}

void check_statistics(const Config& c, Findings& found) {
  if (!c.statistics) return;
  if (!c.fluid)
    found.error({"statistics.start", "fluid"}, "must be absent without a [fluid] section");
  if (c.statistics->grain_forces && !c.grains)
    found.error({"statistics.grain_forces", "grains"}, "must be absent without a [grains] section");
  if (c.statistics->start >= c.time.end) {
    found.error({"statistics.start", "time.end"},
                fmt::format("must be before the end, {:.6g} s", c.time.end));
  }
}

void check_smoothing(const Config& c, const FluidNumbers& flow, double d_mean, Findings& found) {
  const double smallest = std::min({flow.dx, flow.dy_first, flow.dz});
  const double length = c.coupling.smoothing_length;
  if (length == 0 && smallest < 2 * d_mean) {
    found.warning({"coupling.smoothing_length", "fluid.cells"},
                  "is off; with cells below two grain diameters alpha_f is then noisy");
  } else if (length > 0 && length < 0.25 * smallest) {
    found.warning(
        {"coupling.smoothing_length", "fluid.cells"},
        fmt::format("is under a quarter of the smallest cell, {:.3g} m: no effect", smallest));
  } else if (length > 0.25 * c.size[1]) {
    found.warning({"coupling.smoothing_length", "domain.size"},
                  "is over a quarter of the height: it would smear the dune away");
  }
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
  if (narrowest > 0 && n.d_max >= narrowest) {
    found.error(
        {"grains.sizes", "domain.size"},
        fmt::format("holds a diameter of {:.4g} m, wider than the domain, {:.4g} m; lengths "
                    "are in m: 0.2 mm is 2e-4",
                    n.d_max, narrowest));
    return found.all;
  }
  check_grain_step(c, n, found);
  if (c.grains->skin > n.d_min) {
    found.warning({"grains.skin", "grains.sizes"},
                  "is above the smallest diameter: needlessly long neighbour lists");
  }
  // The neighbour search looks at the columns on either side, which must be three different ones.
  const double reach = 3 * (n.d_max + c.grains->skin);
  if ((c.grains->boundary_z == GrainBoundaryZ::periodic && c.size[2] < reach) ||
      (c.grains->boundary_x == GrainBoundaryX::periodic && c.size[0] < reach)) {
    found.error({"domain.size", "grains.sizes", "grains.skin"},
                fmt::format("must be at least {:.3g} m in a periodic direction: a grain would meet "
                            "its own image",
                            reach));
  }
  if (!c.fluid) return found.all;
  if (n.cell_ratio < 1.2 || n.cell_ratio > 1.6) {
    found.warning({"fluid.cells", "fluid.first_cell_height", "grains.sizes", "domain.size"},
                  fmt::format("makes the smallest cell {:.2f} mean grain diameters; the paper "
                              "recommends 1.2 to 1.6",
                              n.cell_ratio));
  }
  check_smoothing(c, *derived.fluid, n.d_mean, found);
  return found.all;
}

std::vector<Finding> validate(const Config& c, const std::vector<SizeClass>& sizes) {
  Findings found;
  check_time(c, found);
  if (!c.fluid && !c.grains) {
    found.error({"fluid", "grains"}, "required, or [grains]: without both there is nothing to run");
    return found.all;
  }
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
