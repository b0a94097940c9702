#include "src/case/derived.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "src/fluid/flow_schedule.hpp"
#include "src/fluid/mesh.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

FluidNumbers derive_fluid(const Config& config) {
  const FluidConfig& fluid = *config.fluid;
  const double nu = fluid.kinematic_viscosity;
  FluidNumbers n;
  const auto& cells = fluid.cells;
  n.cells = std::int64_t{cells[0]} * cells[1] * cells[2];
  n.dx = config.size[0] / cells[0];
  n.dz = config.size[2] / cells[2];
  n.stretching = stretching_ratio(row_spacing(*config.fluid, config.size[1]));
  const auto faces = row_faces(row_spacing(*config.fluid, config.size[1]));
  n.dy_first = faces[1];
  n.dy_last = faces[faces.size() - 1] - faces[faces.size() - 2];
  const std::vector<FlowTarget> schedule = flow_schedule(fluid);
  const int walls = (fluid.bottom == WallFlow::no_slip) + (fluid.top == WallFlow::no_slip);
  n.delta = walls == 0 ? 0 : config.size[1] / walls;
  if (fluid.pressure_gradient) {
    n.pressure_gradient = *fluid.pressure_gradient;
    n.u_star = std::sqrt(std::abs(n.pressure_gradient) * n.delta / fluid.density);
    n.bulk_velocity = bulk_velocity_of(n.u_star, n.delta, nu);
  } else {
    n.bulk_velocity =
        largest(schedule, [](const PlaneVelocity& u) { return std::hypot(u.x, u.z); });
    n.varies = !fluid.schedule.empty();
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
  const double cells_per_second = fluid.pressure_gradient
                                      ? n.bulk_velocity / n.dx
                                      : largest(schedule, [&](const PlaneVelocity& u) {
                                          return std::abs(u.x) / n.dx + std::abs(u.z) / n.dz;
                                        });
  n.cfl = 1.15 * cells_per_second * config.time.fluid_step;
  n.viscous_number = 4 * nu * config.time.fluid_step *
                     (1 / (n.dx * n.dx) + 1 / (n.dy_first * n.dy_first) + 1 / (n.dz * n.dz));
  return n;
}

/// Threshold of motion as a Shields number: Soulsby & Whitehouse (1997).
double soulsby_threshold(double diameter, double submerged, double gravity, double viscosity) {
  const double size = diameter * std::cbrt(submerged * gravity / (viscosity * viscosity));
  return 0.30 / (1 + 1.2 * size) + 0.055 * (1 - std::exp(-0.020 * size));
}

/// Derives the numbers of a kind. `sizes`: of the grains of this kind.
KindNumbers derive_kind(const Config& config, const KindConfig& kind,
                        const std::vector<SizeClass>& sizes,
                        const std::optional<FluidNumbers>& flow) {
  const GrainConfig& grains = *config.grains;
  KindNumbers n{.name = kind.name,
                .spheres = sphere_count(kind.shape),
                .density = kind.density,
                .youngs_modulus = kind.material.youngs_modulus,
                .d_min = std::ranges::min(sizes, {}, &SizeClass::diameter).diameter,
                .d_mean = mean_diameter(sizes)};
  n.r_least = least_radius(kind.shape) * n.d_min;
  n.rayleigh_min = rayleigh_time(n.d_min, kind.density, kind.material);
  n.rayleigh_mean = rayleigh_time(n.d_mean, kind.density, kind.material);
  const AmbientConfig liquid =
      config.fluid ? AmbientConfig{config.fluid->density, config.fluid->kinematic_viscosity}
                   : grains.ambient.value_or(AmbientConfig{0, 0});
  const double nu = liquid.kinematic_viscosity;
  const double gravity = std::hypot(grains.gravity[0], grains.gravity[1], grains.gravity[2]);
  const double weight = std::abs(kind.density - liquid.density) * gravity;
  if (nu > 0 && kind.density > liquid.density) {
    const double ratio = kind.density / liquid.density, submerged = ratio - 1;
    n.fall_velocity = settling_velocity(n.d_mean, ratio, nu, gravity);
    if (flow && flow->u_star > 0 && gravity > 0) {
      n.shields = flow->u_star * flow->u_star / (submerged * gravity * n.d_mean);
      n.shields_threshold = soulsby_threshold(n.d_mean, submerged, gravity, nu);
    }
  }
  n.impact_speed = std::max(n.fall_velocity, flow ? kFastestGrains * flow->bulk_velocity : 0);
  if (grains.contact_model.is<LinearSpring>()) return n;
  n.at_rest = overlap_at_rest(kLayersAtRest, n.d_mean, weight, kind.material);
  n.at_impact = overlap_of_impact(kind.density, n.impact_speed, kind.material);
  return n;
}

GrainNumbers derive_grains(const Config& config, const std::vector<SizeClass>& sizes,
                           const std::optional<FluidNumbers>& flow) {
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
  const std::vector<KindConfig> kinds = all_kinds(*config.grains);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    std::vector<SizeClass> of_kind;
    std::ranges::copy_if(sizes, std::back_inserter(of_kind),
                         [&](const SizeClass& size) { return std::cmp_equal(size.kind, k); });
    if (of_kind.empty()) continue;
    n.kinds.push_back(derive_kind(config, kinds[k], of_kind, flow));
    for (const SizeClass& size : of_kind) n.spheres += n.kinds.back().spheres * size.count;
  }
  n.fastest_contacts = std::ranges::min(n.kinds, {}, &KindNumbers::rayleigh_min);
  n.fraction_min = true_grain_step(config.time) / n.fastest_contacts.rayleigh_min;
  n.fraction_mean = true_grain_step(config.time) / n.fastest_contacts.rayleigh_mean;
  n.easiest = std::ranges::max(n.kinds, {}, [](const KindNumbers& kind) {
    return kind.shields_threshold > 0 ? kind.shields / kind.shields_threshold : 0;
  });
  return n;
}

/// Compares cells with grains. `top`: highest point of the grains [m], 0: not known.
void compare_cells(const Config& config, const FluidNumbers& flow, double top, GrainNumbers& n) {
  n.cell_ratio = std::min({flow.dx, flow.dy_first, flow.dz}) / n.d_mean;
  n.floor_ratio = flow.dy_first / n.d_mean;
  n.column_ratio = flow.dx / n.d_mean;
  n.width_ratio = std::min(flow.dx, flow.dz) / n.d_mean;
  if (top <= 0 || top >= config.size[1]) return;
  const auto faces = row_faces(row_spacing(*config.fluid, config.size[1]));
  const auto above = std::upper_bound(faces.begin(), faces.end(), top);
  n.top = top;
  n.top_ratio = (*above - *(above - 1)) / n.d_mean;
}

}  // namespace

bool is_periodic_x(const Config& config) { return config.grains && is_periodic_x(*config.grains); }

double half_edge_strip(const Config& config) {
  const bool follows = config.grains->boundary_x == GrainBoundaryX::follow && config.fluid;
  return follows ? config.size[0] / config.fluid->cells[0] : 0;
}

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

double overlap_at_rest(int layers, double diameter, double weight, const Material& material) {
  const double s = material.poisson_ratio;
  return std::pow(
      std::numbers::pi / 2 * layers * (1 - s * s) * weight * diameter / material.youngs_modulus,
      2.0 / 3);
}

double overlap_of_impact(double density, double speed, const Material& material) {
  const double s = material.poisson_ratio;
  return std::pow(
      5 * std::numbers::pi / 16 * (1 - s * s) * density * speed * speed / material.youngs_modulus,
      2.0 / 5);
}

double linear_contact_time(double mass, double stiffness) {
  return std::numbers::pi * std::sqrt(mass / (2 * stiffness));
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
  // Bulk velocity by each law of friction alone; friction_velocity takes the larger u*, so U is the
  // smaller.
  const double dean =
      std::pow(u_star * u_star / 0.0365 * std::pow(2 * delta / viscosity, 0.25), 4.0 / 7.0);
  const double laminar = u_star * u_star * delta / (3 * viscosity);
  return std::min(dean, laminar);
}

double settling_velocity(double diameter, double density_ratio, double viscosity, double gravity) {
  const double stokes = (density_ratio - 1) * gravity * diameter * diameter / (18 * viscosity);
  // Bisection of v (1 + 0.15 Re^0.687) = v_Stokes, whose left side grows with v.
  double low = 0, high = stokes;
  for (int n = 0; n < 100; ++n) {
    const double v = 0.5 * (low + high);
    (v * (1 + 0.15 * std::pow(v * diameter / viscosity, 0.687)) < stokes ? low : high) = v;
  }
  return 0.5 * (low + high);
}

Derived derive(const Config& config, const std::vector<SizeClass>& sizes, double top) {
  Derived derived;
  derived.scheme = config.coupling.scheme;
  derived.fluid_steps = fluid_steps(config.time);
  derived.fluid_step = config.time.fluid_step;
  derived.grain_substeps = grain_substeps(config.time);
  derived.grain_step = true_grain_step(config.time);
  if (config.fluid) derived.fluid = derive_fluid(config);
  if (config.grains && !sizes.empty()) {
    derived.grains = derive_grains(config, sizes, derived.fluid);
    if (derived.fluid) compare_cells(config, *derived.fluid, top, *derived.grains);
  }
  return derived;
}

}  // namespace barchan
