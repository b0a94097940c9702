#include "src/config/body_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "src/config/body_extent.hpp"
#include "src/config/keys.hpp"
#include "src/config/names.hpp"
#include "src/config/values.hpp"

namespace barchan {
namespace {

constexpr double kFewCells = 4;    // across a body
constexpr int kMostPosts = 10000;  // of a fence: far more than a flow or a picture can show

std::string key_of(std::size_t n, std::string_view key) {
  return fmt::format("body.{}.{}", n + 1, key);
}

/// Which keys a shape takes beside name, shape, centre and base, and which of them it needs.
struct ShapeKeys {
  std::vector<std::string_view> needs, takes = {};
};

ShapeKeys keys_of(const BodyConfig& body) {
  switch (body.shape) {
    case BodyShape::cylinder:
      if (body.axis == BodyAxis::y) return {{"radius", "height"}, {"axis"}};
      return {{"radius"}, {"axis", "length"}};
    case BodyShape::sphere:
    case BodyShape::half_sphere:
      return {{"radius"}};
    case BodyShape::box:
      return {{"height"}, {"size", "angle"}};
    case BodyShape::fence:
      return {{"radius", "height", "spacing", "length"}, {"angle"}};
    case BodyShape::dune:
      return {{"height", "size", "lee"}};
    case BodyShape::wave:
      return {{"height", "wavelength"}};
  }
  return {};
}

/// What a body is called in messages.
std::string words_for(const BodyConfig& body) {
  const std::string_view shape = kChoiceNames<BodyShape>[static_cast<std::size_t>(body.shape)];
  if (body.shape != BodyShape::cylinder) return fmt::format("shape = \"{}\"", shape);
  return body.axis == BodyAxis::y ? "an upright cylinder" : "a lying cylinder";
}

/// The keys that its shape needs, and no other ones; true if all is well.
bool check_keys(const Config& c, std::size_t n, Findings& found) {
  const ShapeKeys shape = keys_of(c.bodies[n]);
  const auto holds = [](const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  Config plain;
  plain.bodies = {BodyConfig{}};
  bool well = true;
  for (const Section& section : sections()) {
    if (section.name != "body") continue;
    for (const Key& key : section.keys) {
      const bool given = key.text(c, n) != key.text(plain, 0),
                 needed = holds(shape.needs, key.name);
      if (needed)
        well = !found.error_if(!given, {key_of(n, key.name), key_of(n, "shape")},
                               "must be above 0 with {}", words_for(c.bodies[n])) &&
               well;
      if (needed || holds(shape.takes, key.name) ||
          holds({"name", "shape", "centre", "base"}, key.name))
        continue;
      well = !found.error_if(given, {key_of(n, key.name), key_of(n, "shape")},
                             "must be absent with {}", words_for(c.bodies[n])) &&
             well;
    }
  }
  return well;
}

/// What keys cannot say one by one; true if all is well.
bool check_sizes(const BodyConfig& body, std::size_t n, Findings& found) {
  if (body.shape == BodyShape::box)
    return !found.error_if(body.angle != 0 && (body.size[0] == 0 || body.size[1] == 0),
                           {key_of(n, "angle"), key_of(n, "size")},
                           "must be absent for a box through the whole domain");
  if (body.shape == BodyShape::fence) {
    const double posts = 1 + body.length / body.spacing;
    return !found.error_if(body.spacing <= 2 * body.radius,
                           {key_of(n, "spacing"), key_of(n, "radius")},
                           "must be above the diameter of a post, {:.3g} m", 2 * body.radius) &&
           !found.error_if(posts > kMostPosts, {key_of(n, "spacing"), key_of(n, "length")},
                           "must be at least {:.3g} m: a fence has at most {} posts",
                           body.length / (kMostPosts - 1), kMostPosts);
  }
  if (body.shape != BodyShape::dune) return true;
  if (found.error_if(body.base > 0, {key_of(n, "base"), key_of(n, "shape")},
                     "must be at most 0 with shape = \"dune\", which stands on the floor"))
    return false;
  if (found.error_if(body.size[0] == 0 || body.size[1] == 0, {key_of(n, "size")},
                     "must be above 0 along x and along z"))
    return false;
  return !found.error_if(body.lee >= body.size[0], {key_of(n, "lee"), key_of(n, "size")},
                         "must be below the length of the dune, {:.3g} m", body.size[0]);
}

bool is_through(const BodyExtent& extent, const Config& c, std::size_t axis) {
  return extent.low[axis] <= 0 && extent.high[axis] >= c.size[axis];
}

void check_place(const Config& c, std::size_t n, Findings& found) {
  const BodyExtent extent = body_extent(c.bodies[n], c.size);
  for (const std::size_t axis : {0u, 2u}) {
    const double low = extent.low[axis], high = extent.high[axis], most = c.size[axis];
    found.error_if(
        low < -1e-12 * most || high > most * (1 + 1e-12), {key_of(n, "centre"), "domain.size"},
        "must keep the body inside the domain along {}: it reaches from {:.4g} to {:.4g} "
        "m of {:.4g} m",
        axis == 0 ? 'x' : 'z', low, high, most);
  }
  found.error_if(extent.low[1] >= c.size[1] || extent.high[1] <= 0,
                 {key_of(n, "base"), "domain.size"},
                 "must leave a part of the body in the domain: it reaches from {:.4g} to {:.4g} m",
                 extent.low[1], extent.high[1]);
  const bool box = c.bodies[n].shape == BodyShape::box && c.bodies[n].angle == 0;
  const bool blocks =
      (box || is_through(extent, c, 0)) && is_through(extent, c, 1) && is_through(extent, c, 2);
  found.error_if(blocks, {key_of(n, "shape"), "domain.size"},
                 "must leave water beside or above the body");
}

/// What the periods of the domain ask for: a place knows the image whose foot is nearest.
void check_periods(const Config& c, std::size_t n, Findings& found) {
  const BodyConfig& body = c.bodies[n];
  if (body.shape == BodyShape::dune)
    found.error_if(std::max(body.lee, body.size[0] - body.lee) > c.size[0] / 2,
                   {key_of(n, "size"), key_of(n, "lee"), "domain.size"},
                   "must not reach farther from the crest than half the length of the domain, "
                   "{:.4g} m",
                   c.size[0] / 2);
  if (body.shape != BodyShape::wave) return;
  const double waves = c.size[0] / body.wavelength;
  found.error_if(
      std::abs(waves - std::round(waves)) > 1e-6 * waves, {key_of(n, "wavelength"), "domain.size"},
      "must fit into the length of the domain, {:.4g} m, a whole number of times", c.size[0]);
}

/// Along the floor against the cells, upwards against the lowest rows.
void check_resolution(const Config& c, std::size_t n, Findings& found) {
  const auto [nx, ny, nz] = c.fluid->cells;
  double cell = c.size[0] / nx;
  if (nz > 1) cell = std::max(cell, c.size[2] / nz);
  const double first = c.fluid->first_cell_height, row = first > 0 ? first : c.size[1] / ny;
  const double across = smallest_width(c.bodies[n]) / cell;
  const double upwards = body_height(c.bodies[n]) / row;
  found.warning_if(across < kFewCells, {key_of(n, "shape"), "fluid.cells"},
                   "has {:.1f} cells across its smallest width; below {} the flow hardly sees it",
                   across, kFewCells);
  found.warning_if(upwards < kFewCells, {key_of(n, "shape"), "fluid.cells"},
                   "is {:.1f} rows of cells high; below {} the flow hardly sees it", upwards,
                   kFewCells);
}

}  // namespace

void check_bodies(const Config& c, Findings& found) {
  for (std::size_t n = 0; n < c.bodies.size(); ++n) {
    check_name(c.bodies[n].name, {key_of(n, "name")}, found);
    for (std::size_t before = 0; before < n; ++before)
      found.error_if(c.bodies[before].name == c.bodies[n].name, {key_of(n, "name")},
                     "must be another one: \"{}\" is the name of an earlier body",
                     c.bodies[n].name);
    if (!check_keys(c, n, found) || !check_sizes(c.bodies[n], n, found)) continue;
    check_place(c, n, found);
    check_periods(c, n, found);
    if (c.fluid) check_resolution(c, n, found);
  }
}

}  // namespace barchan
