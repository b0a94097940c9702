#include "src/config/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/config/derived.hpp"

namespace barchan {

namespace {

/// A value whose square and cube stay far from the ends of double precision.
struct Bounded {
  std::string key;
  double value, least, most;
};

void add_material(std::vector<Bounded>& all, const std::string& section, const Material& m) {
  all.push_back({section + ".youngs_modulus", m.youngs_modulus, 1e-3, 1e30});
  all.push_back({section + ".sliding_friction", m.sliding_friction, 0, 1e6});
  all.push_back({section + ".rolling_friction", m.rolling_friction, 0, 1e6});
}

/// What the walls do not have from the grains.
void add_wall(std::vector<Bounded>& all, const GrainConfig& g) {
  std::vector<Bounded> inner, wall;
  add_material(inner, "grains", g.material);
  add_material(wall, "grains.wall", g.wall);
  for (std::size_t n = 0; n < wall.size(); ++n) {
    if (wall[n].value != inner[n].value) all.push_back(wall[n]);
  }
}

void add_grains(std::vector<Bounded>& all, const GrainConfig& g) {
  all.push_back({"grains.density", g.density, 1e-6, 1e9});
  add_material(all, "grains", g.material);
  add_wall(all, g);
  all.push_back({"grains.linear_stiffness", g.linear_stiffness, 0, 1e30});
  all.push_back({"grains.rolling_theta_m", g.rolling_theta_m, 1e-9, 1e6});
  all.push_back({"grains.skin", g.skin, 0, 1e3});
  const auto& gravity = g.gravity;
  all.push_back({"grains.gravity",
                 std::max({std::abs(gravity[0]), std::abs(gravity[1]), std::abs(gravity[2])}), 0,
                 1e6});
  if (!g.ambient) return;
  all.push_back({"grains.ambient.density", g.ambient->density, 1e-6, 1e9});
  all.push_back({"grains.ambient.kinematic_viscosity", g.ambient->kinematic_viscosity, 1e-15, 1e6});
}

void add_fluid(std::vector<Bounded>& all, const FluidConfig& f) {
  all.push_back({"fluid.density", f.density, 1e-6, 1e9});
  all.push_back({"fluid.kinematic_viscosity", f.kinematic_viscosity, 0, 1e6});
  all.push_back({"fluid.mean_velocity", f.mean_velocity, 0, 1e6});
  all.push_back({"fluid.pressure_gradient", std::abs(f.pressure_gradient.value_or(0)), 0, 1e12});
  all.push_back({"fluid.top_velocity", std::abs(f.top_velocity), 0, 1e6});
}

std::vector<Bounded> bounded_values(const Config& c) {
  std::vector<Bounded> all;
  all.push_back({"time.fluid_step", c.time.fluid_step, 1e-15, 1});
  all.push_back({"time.grain_step", c.time.grain_step, 1e-18, 1});
  const auto [least, most] = std::minmax_element(c.size.begin(), c.size.end());
  if (*least > 0) {  // else it is missing or wrong, which is told already
    all.push_back({"domain.size", *least, 1e-9, 1e6});
    all.push_back({"domain.size", *most, 1e-9, 1e6});
  }
  if (c.fluid) add_fluid(all, *c.fluid);
  if (c.grains) add_grains(all, *c.grains);
  all.push_back({"coupling.smoothing_length", c.coupling.smoothing_length, 0, 1e6});
  if (c.initial.pour) {
    all.push_back({"initial.grains.pour.radius", c.initial.pour->radius, 1e-9, 1e6});
    all.push_back({"initial.grains.pour.drop_height", c.initial.pour->drop_height, 0, 1e6});
  }
  return all;
}

void check_sizes(const GrainConfig& grains, std::vector<Finding>& found) {
  const auto error = [&](std::string message) {
    found.push_back({Finding::Severity::error, {"grains.sizes"}, std::move(message)});
  };
  for (const SizeClass& size : grains.sizes) {
    if (size.diameter >= 1e-9 && size.diameter <= 1e6) continue;
    error(
        fmt::format("must hold diameters of at least 1e-09 m and at most 1e+06 m; {:.4g} m is not",
                    size.diameter));
    return;
  }
}

}  // namespace

std::vector<Finding> implausible(const Config& c) {
  std::vector<Finding> found;
  for (const Bounded& b : bounded_values(c)) {
    // The negation also finds what is not a number.
    if (b.value >= b.least && b.value <= b.most) continue;
    const bool told = !found.empty() && found.back().keys.front() == b.key;
    if (told) continue;
    found.push_back(
        {Finding::Severity::error,
         {b.key},
         fmt::format("must be at {} {:g} to be computed with", b.value < b.least ? "least" : "most",
                     b.value < b.least ? b.least : b.most)});
  }
  if (c.grains) check_sizes(*c.grains, found);
  // Restart files have the step in ten digits of their name.
  constexpr double most_steps = 9'999'999'999;
  if (c.time.end / c.time.fluid_step > most_steps) {
    found.push_back({Finding::Severity::error,
                     {"time.end", "time.fluid_step"},
                     fmt::format("must be at most {:.3g} s, which is {:.0f} fluid steps; take an "
                                 "earlier end or a longer time.fluid_step",
                                 most_steps * c.time.fluid_step, most_steps)});
  }
  return found;
}

}  // namespace barchan
