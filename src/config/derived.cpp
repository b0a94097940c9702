#include "src/config/derived.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "src/config/mesh.hpp"

namespace barchan {
namespace {

/// Smallest whole number >= x, forgiving what division of decimal steps leaves
/// (100.00000000000001).
double ceil_tolerant(double x) { return std::ceil(x - 1e-9 * std::max(1.0, x)); }

FluidNumbers derive_fluid(const Config& config) {
  const FluidConfig& fluid = *config.fluid;
  const double nu = fluid.kinematic_viscosity;
  FluidNumbers n;
  const auto& cells = fluid.cells;
  n.cells = std::int64_t{cells[0]} * cells[1] * cells[2];
  n.dx = config.size[0] / cells[0];
  n.dz = config.size[2] / cells[2];
  n.stretching = stretching_ratio(row_spacing(config));
  const auto faces = row_faces(row_spacing(config));
  n.dy_first = faces[1];
  n.dy_last = faces[faces.size() - 1] - faces[faces.size() - 2];
  const int walls = (fluid.bottom == WallFlow::no_slip) + (fluid.top == WallFlow::no_slip);
  n.delta = walls == 0 ? 0 : config.size[1] / walls;
  if (fluid.pressure_gradient) {
    n.pressure_gradient = *fluid.pressure_gradient;
    n.u_star = std::sqrt(std::abs(n.pressure_gradient) * n.delta / fluid.density);
    n.bulk_velocity = bulk_velocity_of(n.u_star, n.delta, nu);
  } else {
    n.bulk_velocity = std::hypot(fluid.mean_velocity.x, fluid.mean_velocity.z);
    n.u_star = friction_velocity(n.bulk_velocity, n.delta, nu);
    if (n.delta > 0) n.pressure_gradient = fluid.density * n.u_star * n.u_star / n.delta;
  }
  if (nu > 0) {
    n.reynolds = 2 * n.delta * n.bulk_velocity / nu;
    n.reynolds_tau = n.u_star * n.delta / nu;
    n.y1_plus = 0.5 * n.dy_first * n.u_star / nu;
    n.dx_plus = n.dx * n.u_star / nu;
    n.dz_plus = n.dz * n.u_star / nu;
  }
  n.cfl = 1.15 * n.bulk_velocity * config.time.fluid_step / n.dx;
  n.viscous_number = 4 * nu * config.time.fluid_step *
                     (1 / (n.dx * n.dx) + 1 / (n.dy_first * n.dy_first) + 1 / (n.dz * n.dz));
  return n;
}

/// Threshold of motion as a Shields number: Soulsby & Whitehouse (1997).
double soulsby_threshold(double diameter, double submerged, double gravity, double viscosity) {
  const double size = diameter * std::cbrt(submerged * gravity / (viscosity * viscosity));
  return 0.30 / (1 + 1.2 * size) + 0.055 * (1 - std::exp(-0.020 * size));
}

GrainNumbers derive_grains(const Config& config, const std::vector<SizeClass>& sizes,
                           const std::optional<FluidNumbers>& flow) {
  const GrainConfig& grains = *config.grains;
  GrainNumbers n;
  n.d_min = n.d_max = sizes.front().diameter;
  for (const SizeClass& size : sizes) {
    const auto count = static_cast<double>(size.count);
    n.count += size.count;
    n.d_min = std::min(n.d_min, size.diameter);
    n.d_max = std::max(n.d_max, size.diameter);
    n.solid_volume += count * std::numbers::pi / 6 * std::pow(size.diameter, 3);
  }
  n.d_mean = mean_diameter(sizes);
  n.rayleigh_min = rayleigh_time(n.d_min, grains.density, grains.material);
  n.rayleigh_mean = rayleigh_time(n.d_mean, grains.density, grains.material);
  n.fraction_min = true_grain_step(config.time) / n.rayleigh_min;
  n.fraction_mean = true_grain_step(config.time) / n.rayleigh_mean;
  const AmbientConfig liquid =
      config.fluid ? AmbientConfig{config.fluid->density, config.fluid->kinematic_viscosity}
                   : grains.ambient.value_or(AmbientConfig{0, 0});
  const double nu = liquid.kinematic_viscosity;
  const double gravity = std::hypot(grains.gravity[0], grains.gravity[1], grains.gravity[2]);
  if (nu > 0 && grains.density > liquid.density) {
    const double ratio = grains.density / liquid.density, submerged = ratio - 1;
    n.fall_velocity = settling_velocity(n.d_mean, ratio, nu, gravity);
    if (flow && flow->u_star > 0 && gravity > 0) {
      n.shields = flow->u_star * flow->u_star / (submerged * gravity * n.d_mean);
      n.shields_threshold = soulsby_threshold(n.d_mean, submerged, gravity, nu);
    }
  }
  return n;
}

/// Cells against grains. `top`: highest point of the grains [m], 0: not known.
void compare_cells(const Config& config, const FluidNumbers& flow, double top, GrainNumbers& n) {
  n.cell_ratio = std::min({flow.dx, flow.dy_first, flow.dz}) / n.d_mean;
  n.floor_ratio = flow.dy_first / n.d_mean;
  n.column_ratio = flow.dx / n.d_mean;
  if (top <= 0 || top >= config.size[1]) return;
  const auto faces = row_faces(row_spacing(config));
  const auto above = std::upper_bound(faces.begin(), faces.end(), top);
  n.top = top;
  n.top_ratio = (*above - *(above - 1)) / n.d_mean;
}

}  // namespace

bool exchanges_by_row(const CouplingConfig& coupling) {
  return coupling.exchange == Exchange::by_row && coupling.void_fraction == VoidFraction::divided;
}

std::int64_t fluid_steps(const TimeConfig& time) {
  return static_cast<std::int64_t>(std::min(9e18, ceil_tolerant(time.end / time.fluid_step)));
}

int grain_substeps(const TimeConfig& time) {
  const double steps = ceil_tolerant(time.fluid_step / time.grain_step);
  return static_cast<int>(std::clamp(steps, 1.0, 2e9));
}

double true_grain_step(const TimeConfig& time) { return time.fluid_step / grain_substeps(time); }

double mean_diameter(const std::vector<SizeClass>& sizes) {
  double total = 0;
  std::int64_t count = 0;
  for (const SizeClass& size : sizes) {
    total += static_cast<double>(size.count) * size.diameter;
    count += size.count;
  }
  return total / static_cast<double>(count);
}

double rayleigh_time(double diameter, double density, const Material& material) {
  const double s = material.poisson_ratio;
  const double shear_modulus = material.youngs_modulus / (2 * (1 + s));
  return std::numbers::pi * 0.5 * diameter * std::sqrt(density / shear_modulus) /
         (0.1631 * s + 0.8766);
}

double friction_velocity(double bulk_velocity, double delta, double viscosity) {
  const double speed = std::abs(bulk_velocity);
  if (speed == 0 || viscosity == 0 || delta == 0) return 0;
  const double reynolds = 2 * delta * speed / viscosity;
  const double friction = std::max(0.073 * std::pow(reynolds, -0.25), 12 / reynolds);
  return speed * std::sqrt(0.5 * friction);
}

double bulk_velocity_of(double u_star, double delta, double viscosity) {
  if (u_star == 0 || viscosity == 0 || delta == 0) return 0;
  // Each law of friction alone; friction_velocity takes the larger u*, so U is the smaller.
  const double dean =
      std::pow(u_star * u_star / 0.0365 * std::pow(2 * delta / viscosity, 0.25), 4.0 / 7.0);
  const double laminar = u_star * u_star * delta / (3 * viscosity);
  return std::min(dean, laminar);
}

double settling_velocity(double diameter, double density_ratio, double viscosity, double gravity) {
  const double stokes = (density_ratio - 1) * gravity * diameter * diameter / (18 * viscosity);
  // v (1 + 0.15 Re^0.687) = v_Stokes; the left side grows with v.
  double low = 0, high = stokes;
  for (int n = 0; n < 100; ++n) {
    const double v = 0.5 * (low + high);
    (v * (1 + 0.15 * std::pow(v * diameter / viscosity, 0.687)) < stokes ? low : high) = v;
  }
  return 0.5 * (low + high);
}

Derived derive(const Config& config, const std::vector<SizeClass>& sizes, double top) {
  Derived derived;
  derived.by_row = exchanges_by_row(config.coupling);
  derived.fluid_steps = fluid_steps(config.time);
  derived.grain_substeps = grain_substeps(config.time);
  derived.grain_step = true_grain_step(config.time);
  if (config.fluid) derived.fluid = derive_fluid(config);
  if (config.grains && !sizes.empty()) {
    derived.grains = derive_grains(config, sizes, derived.fluid);
    if (derived.fluid) compare_cells(config, *derived.fluid, top, *derived.grains);
  }
  return derived;
}

namespace {

template <class... Args>
void line(std::string& text, const char* name, fmt::format_string<Args...> value, Args&&... args) {
  text += fmt::format("  {:<24}{}\n", name, fmt::format(value, std::forward<Args>(args)...));
}

void add_fluid(std::string& text, const FluidNumbers& n) {
  line(text, "cells", "{}", n.cells);
  line(text, "cell size", "dx {:.4g}, dy {:.4g} to {:.4g}, dz {:.4g} mm (rows grow by {:.4f})",
       1e3 * n.dx, 1e3 * n.dy_first, 1e3 * n.dy_last, 1e3 * n.dz, n.stretching);
  line(text, "bulk velocity U", "{:.4g} m/s", n.bulk_velocity);
  if (n.u_star > 0) {
    line(text, "Re = 2 delta U / nu", "{:.0f}", n.reynolds);
    line(text, "friction velocity u*", "{:.4g} m/s expected (Dean's law; Re_tau {:.0f})", n.u_star,
         n.reynolds_tau);
    line(text, "in wall units", "y1+ {:.2f}, dx+ {:.1f}, dz+ {:.1f}", n.y1_plus, n.dx_plus,
         n.dz_plus);
    line(text, "driving gradient", "{:.4g} Pa/m", n.pressure_gradient);
  }
  line(text, "CFL at the centreline", "{:.3f}", n.cfl);
  line(text, "viscous number", "{:.2g} (stable below 1)", n.viscous_number);
}

void add_cells_against_grains(std::string& text, const GrainNumbers& n, bool by_row) {
  const std::string top =
      n.top > 0 ? fmt::format(", {:.2f} at {:.3g} mm, the top of the grains{}", n.top_ratio,
                              1e3 * n.top, n.as_poured ? " as poured" : "")
                : "";
  const char* wanted = by_row ? "; by row a surface needs 0.7 or less" : "";
  line(text, "row height / grain", "{:.2f} at the floor{}{}", n.floor_ratio, top, wanted);
  if (!by_row) {
    line(text, "smallest cell / grain", "{:.2f}; this exchange wants 1.2 to 1.6", n.cell_ratio);
  }
}

void add_grains(std::string& text, const GrainNumbers& n, bool by_row) {
  line(text, "grains", "{}, d {:.4g} to {:.4g}, mean {:.4g} mm", n.count, 1e3 * n.d_min,
       1e3 * n.d_max, 1e3 * n.d_mean);
  line(text, "solid volume", "{:.4g} m^3", n.solid_volume);
  line(text, "grain step / Rayleigh", "{:.1f} % (smallest), {:.1f} % (mean grain)",
       100 * n.fraction_min, 100 * n.fraction_mean);
  if (n.fall_velocity > 0) {
    line(text, "fall velocity", "{:.4g} m/s (mean grain alone)", n.fall_velocity);
  }
  if (n.shields > 0) {
    line(
        text, "Shields number",
        "{:.4f}; flat beds move from about {:.4f} on (Soulsby-Whitehouse; here: docs/threshold.md)",
        n.shields, n.shields_threshold);
  }
  if (n.cell_ratio > 0) add_cells_against_grains(text, n, by_row);
}

}  // namespace

std::string to_text(const Derived& derived) {
  std::string text;
  if (derived.fluid) add_fluid(text, *derived.fluid);
  if (derived.grains) add_grains(text, *derived.grains, derived.by_row);
  std::string steps = fmt::format("{}", derived.fluid_steps);
  if (derived.grains) {
    steps += fmt::format(", each of {} grain step{} of {:.4g} s", derived.grain_substeps,
                         derived.grain_substeps == 1 ? "" : "s", derived.grain_step);
  }
  line(text, "steps", "{}", steps);
  return text;
}

}  // namespace barchan
