#include "src/config/start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barchan {
namespace {

/// Of the lattice that a cone of these grains is cut from.
double spacing_of_cone(const std::vector<SizeClass>& sizes) {
  double widest = 0;
  for (const SizeClass& size : sizes) widest = std::max(widest, size.diameter);
  return 1.01 * widest;
}

void check_pour(const Config& c, Findings& found) {
  const PourConfig& pour = *c.initial.pour;
  if (c.grains->sizes.empty()) {
    found.error({"grains.sizes", "initial.grains"}, "must say which grains to pour");
  }
  if (c.grains->frozen) {
    found.error({"grains.frozen", "initial.grains"}, "contradicts pour: grains could not settle");
  }
  for (const int axis : {0, 1}) {
    const double extent = c.size[axis == 0 ? 0 : 2];
    const double at = pour.centre[static_cast<std::size_t>(axis)];
    if (at - pour.radius < 0 || at + pour.radius > extent) {
      found.error({"initial.grains.pour.radius", "initial.grains.pour.centre", "domain.size"},
                  fmt::format("must keep the cone inside the domain; along {} it spans {:.4g} to "
                              "{:.4g} m of 0 to {:.4g} m",
                              axis == 0 ? 'x' : 'z', at - pour.radius, at + pour.radius, extent));
    }
  }
  if (spacing_of_cone(c.grains->sizes) >= c.size[1]) return;  // told by check_grain_sizes
  // The cone is cut from a close-packed lattice one per cent wider than the largest grain.
  const double spacing = spacing_of_cone(c.grains->sizes);
  double count = 0;
  for (const SizeClass& size : c.grains->sizes) count += static_cast<double>(size.count);
  const double volume = count * std::pow(spacing, 3) / std::numbers::sqrt2;
  const double height = 3 * volume / (std::numbers::pi * pour.radius * pour.radius);
  if (height + pour.drop_height > c.size[1]) {
    found.error({"initial.grains.pour.radius", "initial.grains.pour.drop_height", "domain.size"},
                fmt::format("must be larger: the cone would reach about {:.3g} m, above the domain",
                            height + pour.drop_height));
  }
}

}  // namespace

void check_initial(const Config& c, Findings& found) {
  if (!c.fluid && c.initial.fluid != "still") {
    found.error({"initial.fluid", "fluid"}, "must be absent without a [fluid] section");
  }
  const bool given = c.initial.pour.has_value() || !c.initial.grains.empty();
  if (!c.grains && given) {
    found.error({"initial.grains", "grains"}, "must be absent without a [grains] section");
  }
  if (c.grains && !given) {
    found.error({"initial.grains", "initial.grains.pour"},
                "must say where the [grains] start: a file or { pour = {...} }");
  }
  if (c.grains && c.initial.pour) check_pour(c, found);
}

std::vector<Finding> check_start(const Config& c, const Config& start, bool flow) {
  Findings found;
  const std::string key = flow ? "initial.fluid" : "initial.grains";
  if (flow && !start.fluid) {
    found.error({key}, "must be a case with [fluid]");
  } else if (!flow && !start.grains) {
    found.error({key}, "must be a case with [grains]");
  }
  if (!flow || !c.fluid || !start.fluid) return found.all;
  if (start.size != c.size) {
    found.error({key, "domain.size"}, fmt::format("must have the same domain; its size is [{}] m",
                                                  fmt::join(start.size, ", ")));
  }
  if (start.fluid->cells != c.fluid->cells ||
      start.fluid->first_cell_height != c.fluid->first_cell_height) {
    found.error({key, "fluid.cells", "fluid.first_cell_height"},
                fmt::format("must have the same mesh; its cells are [{}] from {:.4g} m",
                            fmt::join(start.fluid->cells, ", "), start.fluid->first_cell_height));
  }
  return found.all;
}

}  // namespace barchan
