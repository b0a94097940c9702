#include "src/config/validate.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace barchan {
namespace {

void check_hertz_step(const Config& c, const GrainNumbers& n, Findings& found) {
  const Keys keys{"time.grain_step", "time.fluid_step",       "grains.sizes",
                  "grains.density",  "grains.youngs_modulus", "grains.poisson_ratio"};
  const std::string text =
      fmt::format("{:.1f} % of the Rayleigh time {:.3g} s of the smallest grain (d = {:.4g} m)",
                  100 * n.fraction_min, n.rayleigh_min, n.d_min);
  if (!found.error_if(n.fraction_min > 0.3, keys,
                      "must be at most {:.3g} s (30 %); the step taken, {:.3g} s, is {}",
                      0.3 * n.rayleigh_min, true_grain_step(c.time), text))
    found.warning_if(n.fraction_min > 0.2, keys, "is {}; above 20 % contacts are coarse", text);
}

/// Linear springs: the step against the duration of a contact of two of the smallest grains,
/// pi sqrt(m / (2 k)).
void check_linear_step(const Config& c, const GrainNumbers& n, Findings& found) {
  if (c.grains->linear_stiffness == 0) return;
  const double mass = c.grains->density * std::numbers::pi / 6 * std::pow(n.d_min, 3);
  const double contact = std::numbers::pi * std::sqrt(mass / (2 * c.grains->linear_stiffness));
  const double fraction = true_grain_step(c.time) / contact;
  const Keys keys{"time.grain_step", "grains.linear_stiffness", "grains.sizes", "grains.density"};
  if (!found.error_if(
          fraction > 0.2, keys,
          "must be at most {:.3g} s, a fifth of the contact of two of the smallest grains",
          0.2 * contact))
    found.warning_if(
        fraction > 0.1, keys,
        "is {:.0f} % of the contact of two of the smallest grains; above 10 % contacts are coarse",
        100 * fraction);
}

}  // namespace

void check_grains(const Config& c, Findings& found) {
  const GrainConfig& grains = *c.grains;
  const bool rolls = grains.material.rolling_friction > 0 || grains.wall.rolling_friction > 0;
  found.error_if(rolls && grains.rolling_model == RollingModel::none,
                 {"grains.rolling_model", "grains.rolling_friction"},
                 "contradicts a rolling_friction above 0");
  const bool linear = grains.contact_model == ContactModel::linear;
  found.error_if(linear && grains.linear_stiffness == 0,
                 {"grains.linear_stiffness", "grains.contact_model"},
                 "must be above 0 with contact_model = \"linear\"");
  found.error_if(!linear && grains.linear_stiffness > 0,
                 {"grains.linear_stiffness", "grains.contact_model"},
                 "must be absent unless contact_model = \"linear\"");
  found.error_if(c.fluid && grains.ambient, {"grains.ambient", "fluid"},
                 "contradicts [fluid]: still water or a computed flow");
  found.warning_if(!c.fluid && grains.frozen, {"grains.frozen"},
                   "and no [fluid]: nothing will move");
  if (!c.fluid) return;
  found.error_if(c.fluid->kinematic_viscosity == 0, {"fluid.kinematic_viscosity"},
                 "must be above 0 with grains: drag needs it");
  found.warning_if(grains.boundary_x == GrainBoundaryX::wall, {"grains.boundary_x"},
                   "stops grains where the fluid, periodic, passes");
  found.warning_if(grains.boundary_z == GrainBoundaryZ::wall, {"grains.boundary_z"},
                   "stops grains where the fluid, periodic, passes");
}

void check_grain_step(const Config& c, const GrainNumbers& n, Findings& found) {
  if (c.grains->frozen) return;
  if (c.grains->contact_model == ContactModel::hertz_mindlin) {
    check_hertz_step(c, n, found);
  } else {
    check_linear_step(c, n, found);
  }
}

}  // namespace barchan
