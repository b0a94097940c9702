#include "src/case/grain_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/case/derived.hpp"
#include "src/case/feed_checks.hpp"
#include "src/case/immersed_checks.hpp"
#include "src/case/kind_checks.hpp"
#include "src/case/shape_checks.hpp"
#include "src/fluid/mesh.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

/// Advice for a step that is `factor` times too long for grains this stiff [Pa]. The Rayleigh time
/// is proportional to E^(-1/2).
std::string softer_grains(double youngs_modulus, double factor) {
  constexpr double kSoftest = 3e5;  // softest of the shipped cases; advice ends there
  const double fits = youngs_modulus / (factor * factor);
  if (fits < kSoftest) return {};
  return fmt::format(
      "; softer grains are usual: below a youngs_modulus of {:.2g} Pa this step "
      "would do (docs/choosing.md)",
      fits);
}

void check_hertz_step(const Config& c, const GrainNumbers& n, Findings& found) {
  const KindNumbers& kind = n.fastest_contacts;
  const std::string of = kind.name.empty() ? "" : fmt::format(" of \"{}\"", kind.name);
  const std::string text =
      fmt::format("{:.1f} % of the Rayleigh time {:.3g} s of the smallest grain{} (d = {:.4g} m)",
                  100 * n.fraction_min, kind.rayleigh_min, of, kind.d_min);
  found.limit(n.fraction_min, 0.2, 0.3,
              {"time.grain_step", "time.fluid_step", "grains.sizes", "grains.density",
               "grains.youngs_modulus", "grains.poisson_ratio"},
              fmt::format("must be at most {:.3g} s (30 %); the step taken, {:.3g} s, is {}{}",
                          0.3 * kind.rayleigh_min, true_grain_step(c.time), text,
                          softer_grains(kind.youngs_modulus, n.fraction_min / 0.3)),
              fmt::format("is {}; above 20 % contacts are less accurate", text));
}

/// Checks the step of linear springs against the duration of a contact of two of the lightest
/// grains.
void check_linear_step(const Config& c, const GrainNumbers& n, Findings& found) {
  if (c.grains->linear_stiffness == 0) return;
  double mass = std::numeric_limits<double>::infinity();
  for (const KindNumbers& kind : n.kinds)
    mass = std::min(mass, kind.density * std::numbers::pi / 6 * std::pow(kind.d_min, 3));
  const double contact = linear_contact_time(mass, c.grains->linear_stiffness);
  const double fraction = true_grain_step(c.time) / contact;
  found.limit(
      fraction, 0.1, 0.2,
      {"time.grain_step", "grains.linear_stiffness", "grains.sizes", "grains.density"},
      fmt::format("must be at most {:.3g} s, a fifth of the contact of two of the smallest grains",
                  0.2 * contact),
      fmt::format("is {:.0f} % of the contact of two of the smallest grains; above 10 % contacts "
                  "are less accurate",
                  100 * fraction));
}

void check_smoothing(const Config& c, const FluidNumbers& flow, double d_mean, Findings& found) {
  if (c.coupling.scheme == CouplingScheme::resolved) return;  // there is no fraction
  const double smallest = std::min({flow.dx, flow.dy_first, flow.dz});
  const double length = c.coupling.smoothing_length;
  const double longest = *std::max_element(c.size.begin(), c.size.end());
  if (found.error_if(length > longest, {"coupling.smoothing_length", "domain.size"},
                     "must be at most {:.4g} m, the longest side of the domain", longest))
    return;
  found.warning_if(length == 0 && smallest < 2 * d_mean,
                   {"coupling.smoothing_length", "fluid.cells"},
                   "is off; with cells below two grain diameters alpha_f is then noisy");
  found.warning_if(length > 0 && length < d_mean && smallest < 2 * d_mean,
                   {"coupling.smoothing_length", "fluid.cells"},
                   "is {:.2g} mean grain diameters; with cells below two diameters alpha_f is then "
                   "noisy; 3 d is usual",
                   length / d_mean);
  if (!found.warning_if(length > 0 && length < 0.25 * smallest,
                        {"coupling.smoothing_length", "fluid.cells"},
                        "is under a quarter of the smallest cell, {:.3g} m: no effect", smallest))
    found.warning_if(length > 0.25 * c.size[1], {"coupling.smoothing_length", "domain.size"},
                     "is over a quarter of the height: it would smear the dune away");
}

/// Checks cells against grains. Thin rows resolve a surface where the exchange goes row by row.
/// Where a grain's force goes to the cells around its centre, or is smeared, the rule of Lima et
/// al. (2022) holds for the smallest cell.
void check_cells(const Config& c, const GrainNumbers& n, Findings& found) {
  const KeyNames keys{"fluid.first_cell_height", "fluid.cells", "grains.sizes", "domain.size"};
  if (is_immersed(c.coupling, *c.grains)) return check_immersed_cells(c, n, found);
  if (c.coupling.scheme == CouplingScheme::resolved) {
    found.warning_if(std::max({n.column_ratio, n.width_ratio, n.floor_ratio}) > 1.0 / 8, keys,
                     "makes cells wider than an eighth of a mean grain: too few for the flow "
                     "around it, 10 or more a diameter");
    return;
  }
  if (c.coupling.scheme != CouplingScheme::layered) {
    found.warning_if(n.cell_ratio < 1.2 || n.cell_ratio > 1.6, keys,
                     "makes the smallest cell {:.2f} mean grain diameters; recommended with this "
                     "exchange: 1.2 to 1.6",
                     n.cell_ratio);
    return;
  }
  found.warning_if(n.column_ratio > 6 && !c.grains->frozen, {"fluid.cells", "domain.size"},
                   "makes cells {:.1f} mean grain diameters long: a dune has a step in each column "
                   "of cells; take 6 or less",
                   n.column_ratio);
  found.warning_if(n.width_ratio < 2 * (1 - 1e-9), {"fluid.cells", "domain.size", "grains.sizes"},
                   "makes cells {:.2f} mean grain diameters narrow: below 2 each belongs to single "
                   "grains, which then read their own wake; take 2.4 or more",
                   n.width_ratio);
  if (!found.warning_if(n.floor_ratio > 1, keys,
                        "makes the lowest row {:.2f} mean grain diameters: too thick for the "
                        "surface of a dune, which needs 0.7 or less",
                        n.floor_ratio))
    found.warning_if(n.floor_ratio * n.d_mean < n.d_max / 6, keys,
                     "makes rows thinner than a sixth of the largest grain: it has none of its "
                     "29 points in some of its rows");
}

/// Displacement of the fluid by a point of a grain, relative to the flow. One of its 29 points that
/// changes cells in a step dt moves its share of the volume, pi/6 d^3 / 29, through an area of
/// about d^2. This is divided by the speed of the flow, or of grains that sink in it, and by the
/// steps in which a grain follows the liquid: tau = (s + 1/2) d^2 / (18 nu).
double push_of_a_point(const Config& c, const Derived& derived) {
  const double nu = c.fluid->kinematic_viscosity, dt = c.time.fluid_step;
  double speed = std::max(derived.fluid->bulk_velocity, std::abs(c.fluid->top_velocity)), most = 0;
  for (const KindNumbers& kind : derived.grains->kinds) speed = std::max(speed, kind.fall_velocity);
  if (speed == 0) return 0;
  for (const KindNumbers& kind : derived.grains->kinds) {
    const double d = kind.d_mean, ratio = kind.density / c.fluid->density;
    const double steps = (ratio + 0.5) * d * d / (18 * nu) / dt;
    most = std::max(most, std::numbers::pi / 6 / 29 * d / (speed * dt) / std::max(1.0, steps));
  }
  return most;
}

/// Warns if that push is strong. Measured with grains of 0.2 mm in a Couette flow: at 1.2 their
/// velocity is 2.9 % off (rms), 0.8 % without the derivative; at 0.9 it is 1.7 %, at 0.2 as
/// without.
void check_push(const Config& c, const Derived& derived, Findings& found) {
  if (c.grains->frozen || !c.coupling.alpha_time_derivative) return;
  if (c.coupling.scheme == CouplingScheme::resolved) return;  // there are no points
  const double push = push_of_a_point(c, derived);
  found.warning_if(push > 0.5,
                   {"coupling.alpha_time_derivative", "time.fluid_step",
                    "fluid.kinematic_viscosity", "grains.sizes"},
                   "pushes the grains about: a point of one that changes cells in so short a step "
                   "squeezes this viscous liquid at {:.2g} of the speed of the flow; set it to "
                   "false (docs/choosing.md)",
                   push);
}

/// Warns of grains that rise, and of those that the flow will not move.
void check_motion(const Config& c, const Derived& derived, Findings& found) {
  const GrainConfig& grains = *c.grains;
  if (grains.frozen) return;
  const double around = c.fluid ? c.fluid->density : grains.ambient ? grains.ambient->density : 0;
  const GrainNumbers& n = *derived.grains;
  for (const KindNumbers& kind : n.kinds) {
    const std::string who =
        kind.name.empty() ? "the grains" : fmt::format("those of \"{}\"", kind.name);
    found.warning_if(kind.density <= around, {"grains.density", "fluid.density"},
                     "is not above that of the fluid, {:.6g} kg/m3: {} float", around, who);
    check_smallest_sphere(c, kind, who, found);
  }
  // Laminar flows get no warning: their beds are as a rule so deep that u* of the whole height says
  // little.
  const bool turbulent = derived.fluid && derived.fluid->reynolds > 2000;
  found.warning_if(
      turbulent && n.easiest.shields < n.easiest.shields_threshold,
      {"fluid.mean_velocity", "grains.sizes"},
      "gives a Shields number of {:.3f}, below the {:.3f} at which sand begins to move: "
      "expect no bed load",
      n.easiest.shields, n.easiest.shields_threshold);
}

void check_floor(const GrainConfig& grains, const std::array<double, 3>& size, Findings& found) {
  const bool glued = grains.floor == GrainFloor::glued;
  const double d = grains.floor_diameter;
  found.error_if(glued && d == 0, {"grains.floor_diameter", "grains.floor"},
                 "must be above 0 with floor = \"glued\"");
  found.error_if(!glued && d > 0, {"grains.floor_diameter", "grains.floor"},
                 "must be absent unless floor = \"glued\"");
  found.error_if(glued && (size[0] < 3 * d || size[2] < std::sqrt(3) * d),
                 {"grains.floor_diameter", "domain.size"},
                 "must be smaller: a glued floor is at least 3 spheres long and 2 rows wide");
}

}  // namespace

void check_grains(const Config& c, Findings& found) {
  const GrainConfig& grains = *c.grains;
  bool rolls = grains.wall.rolling_friction > 0;
  for (const KindConfig& kind : all_kinds(grains))
    rolls = rolls || kind.material.rolling_friction > 0;
  for (const PairConfig& pair : grains.pairs)
    rolls = rolls || pair.rolling_friction.value_or(0) > 0;
  found.error_if(rolls && grains.rolling_model.is<NoRolling>(),
                 {"grains.rolling_model", "grains.rolling_friction"},
                 "contradicts a rolling_friction above 0");
  const bool linear = grains.contact_model.is<LinearSpring>();
  found.error_if(linear && grains.linear_stiffness == 0,
                 {"grains.linear_stiffness", "grains.contact_model"},
                 "must be above 0 with contact_model = \"linear\"");
  found.error_if(!linear && grains.linear_stiffness > 0,
                 {"grains.linear_stiffness", "grains.contact_model"},
                 "must be absent unless contact_model = \"linear\"");
  check_floor(grains, c.size, found);
  check_kinds(grains, found);
  check_shapes(c, found);
  const bool immersed = c.fluid && is_immersed(c.coupling, grains);
  if (immersed) check_immersed(c, found);
  found.error_if(grains.contact_model.is<HertzLubricated>() && !immersed,
                 {"grains.contact_model", "coupling.scheme", "grains.frozen"},
                 "must come with grains that move in a resolved flow, whose film it is");
  found.error_if(c.fluid && grains.ambient, {"grains.ambient", "fluid"},
                 "contradicts [fluid]: still water or a computed flow");
  check_following(c, found);
  check_feed(c, found);
  found.warning_if(!c.fluid && grains.frozen, {"grains.frozen"},
                   "and no [fluid]: nothing will move");
  if (!c.fluid) return;
  found.error_if(c.fluid->kinematic_viscosity == 0, {"fluid.kinematic_viscosity"},
                 "must be above 0 with grains: drag needs it");
  found.error_if(
      c.fluid->cells[1] < 2, {"fluid.cells", "grains"},
      "must be at least 2 rows high with grains: in one row the water does not lose what "
      "they gain");
  found.warning_if(grains.boundary_x == GrainBoundaryX::wall, {"grains.boundary_x"},
                   "stops grains where the fluid, periodic, passes");
  found.warning_if(grains.boundary_z == GrainBoundaryZ::wall, {"grains.boundary_z"},
                   "stops grains where the fluid, periodic, passes");
  found.warning_if(c.coupling.forces == ForceSwitches{false, false, false, false, false},
                   {"coupling.forces"}, "is empty: the flow does not move the grains");
}

std::vector<Finding> check_grain_sizes(const Config& c, const std::vector<SizeClass>& sizes) {
  Findings found;
  if (!c.grains || sizes.empty()) return {};
  if (c.fluid && !rows_fit(row_spacing(*c.fluid, c.size[1]))) return {};
  const Derived derived = derive(c, sizes);
  const GrainNumbers& n = *derived.grains;
  const double narrowest = *std::min_element(c.size.begin(), c.size.end());
  if (found.error_if(
          narrowest > 0 && n.d_max >= narrowest, {"grains.sizes", "domain.size"},
          "holds a diameter of {:.4g} m, wider than the domain, {:.4g} m; lengths are in m: "
          "0.2 mm is 2e-4",
          n.d_max, narrowest))
    return found.all;
  if (!c.grains->frozen) {
    const bool hertz = !c.grains->contact_model.is<LinearSpring>();
    (hertz ? check_hertz_step : check_linear_step)(c, n, found);
  }
  // The hole between three glued spheres is 0.155 of their diameter wide.
  found.error_if(
      c.grains->floor == GrainFloor::glued && n.d_min < c.grains->floor_diameter / 4,
      {"grains.floor_diameter", "grains.sizes"},
      "is more than four times the smallest diameter, {:.4g} m: grains would fall between "
      "the glued spheres",
      n.d_min);
  found.warning_if(c.grains->skin > n.d_min, {"grains.skin", "grains.sizes"},
                   "is above the smallest diameter: needlessly long neighbour lists");
  found.warning_if(
      n.d_max > 3 * n.d_min && c.grains->kinds.size() < 2 && !c.grains->frozen,
      {"grains.sizes", "grains.kind"},
      "holds diameters of 1 to {:.3g}: beyond 3 friction may hold small grains between "
      "large ones; give the small ones a [[grains.kind]] of their own "
      "(docs/theory-grains.md)",
      n.d_max / n.d_min);
  // The neighbour search looks at the columns on either side, which must be three different ones.
  const double reach = 3 * (n.d_max + c.grains->skin + film_reach(c));
  found.error_if(
      (c.grains->boundary_z == GrainBoundaryZ::periodic && c.size[2] < reach) ||
          (is_periodic_x(c) && c.size[0] < reach),
      {"domain.size", "grains.sizes", "grains.skin"},
      "must be at least {:.3g} m in a periodic direction: a grain would meet its own image", reach);
  check_clump_sizes(c, sizes, found);
  check_fed_sizes(c, widths_of(*c.grains, sizes).most, found);
  check_motion(c, derived, found);
  if (!c.fluid) return found.all;
  check_cells(c, n, found);
  check_push(c, derived, found);
  check_smoothing(c, *derived.fluid, n.d_mean, found);
  return found.all;
}

}  // namespace barchan
