// Text of the derived numbers, as `check` prints it.
#include <utility>

#include <fmt/format.h>

#include "src/case/derived.hpp"

namespace barchan {

namespace {

template <class... Args>
void line(std::string& text, const char* name, fmt::format_string<Args...> value, Args&&... args) {
  text += fmt::format("  {:<24}{}\n", name, fmt::format(value, std::forward<Args>(args)...));
}

void add_fluid(std::string& text, const FluidNumbers& n) {
  line(text, "cells", "{}", n.cells);
  line(text, "cell size", "dx {:.4g}, dy {:.4g} to {:.4g}, dz {:.4g} mm (rows grow by {:.4f})",
       1e3 * n.dx, 1e3 * n.dy_first, 1e3 * n.dy_last, 1e3 * n.dz, n.stretching);
  line(text, "bulk velocity U", "{:.4g} m/s{}", n.bulk_velocity,
       n.varies ? ", the largest; what follows is of it" : "");
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

void add_cells_against_grains(std::string& text, const GrainNumbers& n, CouplingScheme scheme) {
  const std::string top =
      n.top > 0 ? fmt::format(", {:.2f} at {:.3g} mm, the top of the grains{}", n.top_ratio,
                              1e3 * n.top, n.as_poured ? " as poured" : "")
                : "";
  const bool layered = scheme == CouplingScheme::layered;
  const char* limit = layered ? " (recommended: 0.7 or less)" : "";
  line(text, "row height / grain", "{:.2f} at the floor{}{}", n.floor_ratio, top, limit);
  if (layered) return;
  if (scheme == CouplingScheme::resolved) {
    line(text, "cells a diameter", "{:.1f} of the mean grain (recommended: 10 or more)",
         1 / n.cell_ratio);
    return;
  }
  line(text, "smallest cell / grain", "{:.2f} (recommended with this exchange: 1.2 to 1.6)",
       n.cell_ratio);
}

/// Adds the lines of a kind. With several kinds each line names its own.
void add_kind(std::string& text, const KindNumbers& n) {
  const std::string of = n.name.empty() ? "" : n.name + ": ";
  if (!of.empty()) line(text, "density", "{}{:.6g} kg/m3", of, n.density);
  if (n.at_rest > 0) {
    const std::string impact = n.impact_speed > 0
                                   ? fmt::format(", {:.2g} % in undamped impacts at {:.2g} m/s",
                                                 100 * n.at_impact, n.impact_speed)
                                   : "";
    line(text, "overlap", "{}{:.2g} % under {} layers{} (docs/choosing.md)", of, 100 * n.at_rest,
         kLayersAtRest, impact);
  }
  if (n.fall_velocity > 0)
    line(text, "fall velocity", "{}{:.4g} m/s ({} alone)", of, n.fall_velocity,
         n.spheres > 1 ? "sphere of the mean grain's volume" : "mean grain");
  if (n.shields > 0) {
    line(text, "Shields number",
         "{}{:.4f}; flat beds move from about {:.4f} on (Soulsby-Whitehouse; here: "
         "docs/threshold.md)",
         of, n.shields, n.shields_threshold);
  }
}

void add_grains(std::string& text, const GrainNumbers& n, CouplingScheme scheme) {
  const std::string of = n.spheres > n.count ? fmt::format(" of {} spheres", n.spheres) : "";
  line(text, "grains", "{}{}, d {:.4g} to {:.4g}, mean {:.4g} mm", n.count, of, 1e3 * n.d_min,
       1e3 * n.d_max, 1e3 * n.d_mean);
  line(text, "solid volume", "{:.4g} m^3", n.solid_volume);
  line(text, "grain step / Rayleigh", "{:.1f} % (smallest), {:.1f} % (mean grain)",
       100 * n.fraction_min, 100 * n.fraction_mean);
  for (const KindNumbers& kind : n.kinds) add_kind(text, kind);
  if (n.cell_ratio > 0) add_cells_against_grains(text, n, scheme);
}

}  // namespace

std::string summary(const Derived& derived) {
  std::string text;
  if (derived.fluid) text += fmt::format("{} cells, ", derived.fluid->cells);
  if (derived.grains) {
    const GrainNumbers& n = *derived.grains;
    text +=
        fmt::format("{} grains of {:.4g} to {:.4g} mm, ", n.count, 1e3 * n.d_min, 1e3 * n.d_max);
  }
  text += fmt::format("{} steps", derived.fluid_steps);
  if (derived.grains) text += fmt::format(" of {} grain steps", derived.grain_substeps);
  return text;
}

std::string to_text(const Derived& derived) {
  std::string text;
  if (derived.fluid) add_fluid(text, *derived.fluid);
  if (derived.grains) add_grains(text, *derived.grains, derived.scheme);
  std::string steps = fmt::format("{} of {:.4g} s", derived.fluid_steps, derived.fluid_step);
  if (derived.grains) {
    steps += fmt::format(", each of {} grain step{} of {:.4g} s", derived.grain_substeps,
                         derived.grain_substeps == 1 ? "" : "s", derived.grain_step);
  }
  line(text, "steps", "{}", steps);
  return text;
}

}  // namespace barchan
