#include "src/case/validate.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "src/case/body_checks.hpp"
#include "src/case/derived.hpp"
#include "src/case/flow_checks.hpp"
#include "src/case/grain_checks.hpp"
#include "src/case/heap_checks.hpp"
#include "src/case/no_effect.hpp"
#include "src/case/output_checks.hpp"
#include "src/fluid/flow_schedule.hpp"
#include "src/fluid/mesh.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

void check_time(const Config& c, Findings& found) {
  constexpr double max_steps = 9'999'999'999;  // restart files have ten digits in their names
  found.error_if(c.time.end / c.time.fluid_step > max_steps, {"time.end", "time.fluid_step"},
                 "must be at most {:.3g} s, which is {:.0f} fluid steps; take an earlier end or a "
                 "longer time.fluid_step",
                 max_steps * c.time.fluid_step, max_steps);
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

void check_flow_step(const Config& c, const FluidNumbers& n, Findings& found) {
  if (found.limit(
          n.stretching, 1.1, 2,
          {"fluid.first_cell_height", "fluid.uniform_height", "fluid.cells", "domain.size"},
          fmt::format("must be larger: rows would grow by {:.3g} each, of at most 2 (better "
                      "1.1); more rows help as well",
                      n.stretching),
          fmt::format("makes rows grow by {:.3f} each; above 1.1 is coarse: take more rows",
                      n.stretching)))
    return;
  found.limit(n.cfl, 0.5, 1,
              {"time.fluid_step", "fluid.cells", "fluid.mean_velocity", "domain.size"},
              fmt::format("must keep the CFL number below 1; the mean flow alone has {:.2f} at the "
                          "centreline",
                          n.cfl),
              fmt::format("gives a CFL number of {:.2f} for the mean flow alone; fluctuations come "
                          "on top, keep below 0.5",
                          n.cfl));
  const bool only_molecular = c.fluid->turbulence == Turbulence::none &&
                              (!c.grains || c.coupling.scheme == CouplingScheme::resolved);
  found.limit(n.viscous_number, only_molecular ? 1 : 0.5, 1,
              {"time.fluid_step", "fluid.cells", "fluid.kinematic_viscosity", "domain.size"},
              fmt::format("must be at most {:.3g} s: viscosity is explicit and the smallest cell "
                          "sets the limit",
                          c.time.fluid_step / n.viscous_number),
              "is over half of the viscous limit; the viscosity of eddies or grains comes on top");
}

/// Checks the rows; true if they cannot fill the height.
bool check_rows(const Config& c, Findings& found) {
  const RowSpacing rows = row_spacing(*c.fluid, c.size[1]);
  if (rows_fit(rows)) return false;
  const std::vector<std::string> keys{"fluid.first_cell_height", "fluid.cells", "domain.size"};
  if (rows.first > rows.height / rows.rows) {
    return found.error_if(true, keys,
                          "must be at most Ly / ny = {:.4g} m: the rows grow from the floor "
                          "upwards, or are all equal",
                          rows.height / rows.rows);
  }
  const int equal = uniform_rows(rows);
  return found.error_if(
      true, {"fluid.uniform_height", "fluid.first_cell_height", "fluid.cells", "domain.size"},
      "must be lower: {} of {} rows are as high as the first, {:.4g} m, and those above may not "
      "shrink",
      equal, rows.rows, rows.first);
}

void check_fluid(const Config& c, Findings& found) {
  const FluidConfig& fluid = *c.fluid;
  const bool held = fluid.mean_velocity != PlaneVelocity{};
  const bool driven = !flow_schedule(fluid).empty() || fluid.pressure_gradient.value_or(0) != 0;
  found.error_if(fluid.pressure_gradient && held,
                 {"fluid.pressure_gradient", "fluid.mean_velocity"},
                 "contradicts mean_velocity: give one of the two");
  check_schedule(c, found);
  found.error_if(fluid.top_velocity != 0 && fluid.top != WallFlow::no_slip,
                 {"fluid.top_velocity", "fluid.top"}, "must come with top = \"no_slip\"");
  if (!found.error_if(fluid.ramp_time > 0 && !held, {"fluid.ramp_time", "fluid.mean_velocity"},
                      "must be absent without a mean_velocity to bring up"))
    found.warning_if(fluid.ramp_time > c.time.end, {"fluid.ramp_time", "time.end"},
                     "is longer than the run");
  found.error_if(c.coupling.forces.wall_drag && fluid.bottom != WallFlow::no_slip,
                 {"coupling.forces", "fluid.bottom"},
                 "must not hold \"wall_drag\" over a free-slip bottom, which is no wall to drag");
  found.warning_if(
      c.coupling.forces.mixture_viscosity && c.coupling.scheme != CouplingScheme::layered,
      {"coupling.forces", "coupling.scheme"},
      "holds \"mixture_viscosity\", which acts only with scheme = \"layered\"");
  check_flow_at_start(c, found);
  found.error_if(c.initial.starts_as<TurbulentFlow>() && fluid.kinematic_viscosity == 0,
                 {"initial.fluid", "fluid.kinematic_viscosity"}, "must come with a viscosity");
  found.error_if(fluid.uniform_height > 0 && fluid.first_cell_height == 0,
                 {"fluid.uniform_height", "fluid.first_cell_height"},
                 "must come with a first_cell_height, the height of those rows");
  constexpr int min_rows = 8;
  found.warning_if(
      driven && fluid.bottom == WallFlow::no_slip && fluid.cells[1] < min_rows,
      {"fluid.cells", "fluid.bottom"},
      "has {} rows over a no-slip floor; with fewer than {} the shear at the floor, and "
      "u* with it, is far off",
      fluid.cells[1], min_rows);
  if (!check_rows(c, found)) check_flow_step(c, *derive(c, {}).fluid, found);
}

void check_initial(const Config& c, Findings& found) {
  found.error_if(!c.fluid && !c.initial.starts_as<StillFlow>(), {"initial.fluid", "fluid"},
                 "must be absent without a [fluid] section");
  const bool given = c.initial.pour.has_value() || !c.initial.grains.empty();
  const bool heaps = !c.initial.heaps.empty();
  found.error_if(!c.grains && given, {"initial.grains", "grains"},
                 "must be absent without a [grains] section");
  found.error_if(!c.grains && heaps, {"initial.heap", "grains"},
                 "must be absent without a [grains] section");
  found.error_if(!c.grains && !c.initial.craters.empty(), {"initial.crater", "grains"},
                 "must be absent without a [grains] section");
  found.error_if(given && heaps, {"initial.heap", "initial.grains"},
                 "contradicts initial.grains: the grains come from one of the two");
  found.error_if(c.grains && !given && !heaps, {"initial.grains", "initial.grains.pour"},
                 "must say where the [grains] start: a file or {{ pour = {{...}} }}");
}

/// Checks an interval of writing or sampling against the steps, which are what they are.
void check_interval(const Config& c, const std::string& key, double interval, Findings& found) {
  const double step = c.time.fluid_step, steps = interval / step;
  found.warning_if(steps > 1 && interval <= c.time.end && !is_whole(steps),
                   {key, "time.fluid_step"},
                   "is no multiple of fluid_step, {:.6g} s: each time is that of the first step at "
                   "or after a multiple of it; the nearest that is one is {:.6g} s",
                   step, std::round(steps) * step);
}

void check_output(const Config& c, Findings& found) {
  using O = OutputConfig;
  const auto check = [&](const char* key, double O::*member, bool is_written = true) {
    const double interval = c.output.*member;
    if (is_written && interval != O{}.*member) check_interval(c, key, interval, found);
    found.warning_if(interval > 0 && interval < c.time.fluid_step * (1 - 1e-9), {key},
                     "is shorter than a fluid step; written after every step");
    // The default may be longer than a short run.
    found.warning_if(interval > c.time.end * (1 + 1e-9) && interval != O{}.*member, {key},
                     "is longer than the run, {:.6g} s; only the start is written", c.time.end);
  };
  check("output.history_interval", &O::history_interval);
  check("output.dune_interval", &O::dune_interval, c.grains.has_value());
  check("output.grains_interval", &O::grains_interval, c.grains.has_value());
  check("output.fields_interval", &O::fields_interval, c.fluid.has_value());
  check("output.tracks_interval", &O::tracks_interval, c.grains.has_value());
  const O& o = c.output;
  for (std::size_t n = 0; n < o.probes.size(); ++n)
    check_interval(c, fmt::format("output.probe.{}.interval", n + 1), o.probes[n].interval, found);
  for (std::size_t n = 0; n < o.slices.size(); ++n)
    check_interval(c, fmt::format("output.slice.{}.interval", n + 1), o.slices[n].interval, found);
  const bool grains =
      c.grains && (o.dune_interval > 0 || o.grains_interval > 0 || o.tracks_interval > 0);
  found.warning_if(o.history_interval == 0 && !grains && !(c.fluid && o.fields_interval > 0) &&
                       !c.statistics && o.probes.empty() && o.slices.empty(),
                   {"output.history_interval"},
                   "is 0 as all other intervals: the run leaves nothing but its last state");
}

void check_bed_load(const Config& c, Findings& found) {
  const std::vector<std::string> with_grains{"statistics.bed_load", "grains"};
  if (found.error_if(!c.grains, with_grains, "must be absent without a [grains] section")) return;
  found.error_if(c.grains->frozen, {"statistics.bed_load", "grains.frozen"},
                 "must be absent with frozen grains: none moves");
  found.error_if(!c.bodies.empty(), {"statistics.bed_load", "body"},
                 "must be absent with bodies: what they take of the stress is not known by height");
  found.error_if(c.grains->boundary_x == GrainBoundaryX::wall,
                 {"statistics.bed_load", "grains.boundary_x"},
                 "must be absent with walls at the ends: they take a part of the stress");
  found.error_if(c.grains->gravity[1] >= 0, {"statistics.bed_load", "grains.gravity"},
                 "must come with gravity towards the floor");
}

void check_statistics(const Config& c, Findings& found) {
  if (!c.statistics) return;
  found.error_if(!c.fluid, {"statistics.start", "fluid"},
                 "must be absent without a [fluid] section");
  found.error_if(c.statistics->grain_forces && !c.grains, {"statistics.grain_forces", "grains"},
                 "must be absent without a [grains] section");
  if (c.statistics->bed_load) check_bed_load(c, found);
  found.error_if(c.statistics->start >= c.time.end, {"statistics.start", "time.end"},
                 "must be before the end, {:.6g} s", c.time.end);
  check_interval(c, "statistics.interval", c.statistics->interval, found);
}

}  // namespace

/// Checks that the window of a case lies in the box of the case that it starts from.
void check_window(const Config& c, const Config& start, Findings& found) {
  const auto [x, z] = *c.initial.window;
  const bool fits = x >= 0 && x + c.size[0] <= start.size[0] && z >= 0 &&
                    z + c.size[2] <= start.size[2] && c.size[1] <= start.size[1];
  found.error_if(!fits, {"initial.window", "domain.size"},
                 "must lie with the whole domain in the box of the other case, [{}] m",
                 fmt::join(start.size, ", "));
}

/// Checks that kinds have the shapes that they have in the case that this one starts from.
void check_shapes_of_start(const GrainConfig& grains, const GrainConfig& start,
                           const std::string& key, Findings& found) {
  for (const KindConfig& kind : all_kinds(start)) {
    const int here = std::max(kind_of_name(grains, kind.name), 0);
    const std::string fault = unlike_shape(grains, here, kind.shape);
    if (found.error_if(!fault.empty(), {key, "grains.shape", "grains.kind"}, "must {}", fault))
      return;
  }
}

std::vector<Finding> check_start(const Config& c, const Config& start, bool flow) {
  Findings found;
  const std::string key = flow ? "initial.fluid" : "initial.grains";
  found.error_if(flow && !start.fluid, {key}, "must be a case with [fluid]");
  found.error_if(!flow && !start.grains, {key}, "must be a case with [grains]");
  if (!flow && c.grains && start.grains) {
    const std::string problem = unknown_kinds(*c.grains, names_of_kinds(*start.grains));
    if (!found.error_if(!problem.empty(), {key, "grains.kind"}, "must {}", problem))
      check_shapes_of_start(*c.grains, *start.grains, key, found);
  }
  if (c.initial.window) check_window(c, start, found);
  if (!flow || !c.fluid || !start.fluid || c.initial.window) return found.all;
  found.error_if(start.size != c.size, {key, "domain.size"},
                 "must have the same domain; its size is [{}] m", fmt::join(start.size, ", "));
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
  if (c.grains) check_heaps(c, found);
  check_bodies(c, found);
  check_initial(c, found);
  check_effects(c, found);
  check_output(c, found);
  check_probe_keys(c, found);
  check_slice_keys(c, found);
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
    lines.push_back(
        fmt::format("[{}] {} {}", key.substr(0, dot), key.substr(dot + 1), finding.message));
  }
  return lines;
}

}  // namespace barchan
