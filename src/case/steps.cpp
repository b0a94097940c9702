#include "src/case/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/step_limit.hpp"
#include "src/case/derived.hpp"
#include "src/case/immersed_checks.hpp"
#include "src/fluid/mesh.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The largest `mantissa` times a power of ten that is not above `limit`.
template <std::size_t N>
double rounded_down(double limit, const double (&mantissas)[N]) {
  const double exponent = std::floor(std::log10(limit)), scale = std::pow(10, -exponent);
  double best = mantissas[0];
  for (const double m : mantissas) {
    if (m <= limit * scale * (1 + 1e-9)) best = m;
  }
  return best / scale;
}

/// Longest stable step [s] of a grain that six others touch under the weight of 15 layers. `spin`:
/// its inertia against spin, as in InertiaInContacts.
double stable_step_in_bed(double d, double d_mean, double density, double weight,
                          const Material& material, double tangential_damping, double spin) {
  constexpr int contacts = 6;
  const Elastic elastic{.youngs_modulus = material.youngs_modulus,
                        .poisson_ratio = material.poisson_ratio};
  const HertzMindlin law = HertzMindlin::from({.a = elastic,
                                               .b = elastic,
                                               .restitution = material.restitution,
                                               .tangential_damping = tangential_damping});
  const double mass = density * std::numbers::pi / 6 * d * d * d;
  const double overlap = d_mean * overlap_at_rest(kLayersAtRest, d_mean, weight, material);
  const ContactStiffness k = law(d / 4, mass / 2, overlap);
  return stable_step(contacts * k.k_t, contacts * k.gamma_t, spin * mass);
}

/// Longest grain step for one size of grains [s].
double limit_of(const SizeClass& size, double d_mean, const Config& config) {
  const GrainConfig& grains = *config.grains;
  const KindConfig kind = all_kinds(grains)[static_cast<std::size_t>(size.kind)];
  if (grains.contact_model.is<LinearSpring>()) {
    const double mass = kind.density * std::numbers::pi / 6 * std::pow(size.diameter, 3);
    return 0.1 * linear_contact_time(mass, grains.linear_stiffness);
  }
  const double rayleigh = 0.2 * rayleigh_time(size.diameter, kind.density, kind.material);
  const double gravity = std::hypot(grains.gravity[0], grains.gravity[1], grains.gravity[2]);
  const double around = config.fluid     ? config.fluid->density
                        : grains.ambient ? grains.ambient->density
                                         : 0;
  const double weight = std::abs(kind.density - around) * gravity;
  if (weight == 0 || kind.material.sliding_friction == 0) return rayleigh;
  return std::min(
      rayleigh, 0.9 * stable_step_in_bed(size.diameter, d_mean, kind.density, weight, kind.material,
                                         grains.tangential_damping, inertia_of(kind.shape).spin));
}

double grain_step_limit(const Config& config, const std::vector<SizeClass>& sizes) {
  if (!config.grains || config.grains->frozen || sizes.empty()) return kNoLimit;
  double limit = kNoLimit;
  for (const SizeClass& size : sizes)
    limit = std::min(limit, limit_of(size, mean_diameter(sizes), config));
  return std::min(limit, film_step_limit(config, sizes));
}

/// Longest fluid step for the flow, and for grains that sink in it [s].
double fluid_step_limit(const Config& config, const std::vector<SizeClass>& sizes) {
  if (!config.fluid) return 100 * grain_step_limit(config, sizes);
  if (!rows_fit(row_spacing(*config.fluid, config.size[1])))
    return kNoLimit;  // an error that is reported elsewhere
  Config one = config;
  one.time.fluid_step = one.time.grain_step = 1;
  const Derived of_one_second = derive(one, sizes);
  const FluidNumbers& n = *of_one_second.fluid;
  double limit = std::min(0.13 / n.cfl, 0.4 / n.viscous_number);
  limit = std::min(limit, 0.15 * n.dx / std::abs(config.fluid->top_velocity));
  if (!of_one_second.grains) return limit;
  for (const KindNumbers& kind : of_one_second.grains->kinds)
    limit = std::min(limit, 0.5 * n.dy_first / kind.fall_velocity);
  return limit;
}

}  // namespace

double chosen_fluid_step(const Config& config, const std::vector<SizeClass>& sizes) {
  const double limit = fluid_step_limit(config, sizes);
  if (!std::isfinite(limit) || limit <= 0) return config.time.fluid_step;
  const double step = rounded_down(limit, {1, 1.25, 2, 2.5, 4, 5});
  return config.time.end > 0 ? std::min(step, config.time.end) : step;
}

double chosen_grain_step(const Config& config, const std::vector<SizeClass>& sizes) {
  const double limit = grain_step_limit(config, sizes);
  if (!std::isfinite(limit) || limit <= 0) return config.time.grain_step;
  const double digits = std::pow(10, std::floor(std::log10(limit)) - 1);
  return std::min(std::floor(limit / digits) * digits, config.time.fluid_step);
}

}  // namespace barchan
