#include "src/case/body_checks.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "src/bodies/body_extent.hpp"
#include "src/toml/keys.hpp"
#include "src/toml/names.hpp"
#include "src/toml/values.hpp"

namespace barchan {
namespace {

using namespace std::string_view_literals;

constexpr std::array kKeysOfAll{"name"sv, "shape"sv, "centre"sv, "base"sv};
constexpr double kFewCells = 4;  // across a body

std::string key_of(std::size_t n, std::string_view key) {
  return fmt::format("body.{}.{}", n + 1, key);
}

/// Name of a body in messages.
std::string words_for(const BodyConfig& body) {
  std::string words = fmt::format("shape = \"{}\"", body.shape.word());
  BodyShapes::with(body.shape, [&]<class Shape>() {
    if constexpr (requires { Shape::words(body); }) words = Shape::words(body);
  });
  return words;
}

/// Checks that a body has the keys that its shape needs, and no others; true if all is well.
bool check_keys(const Config& c, std::size_t n, Findings& found) {
  ShapeKeys shape;
  BodyShapes::with(c.bodies[n].shape, [&]<class S>() { shape = S::keys(c.bodies[n]); });
  const auto holds = [](const auto& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
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
      if (needed || holds(shape.takes, key.name) || holds(kKeysOfAll, key.name)) continue;
      well = !found.error_if(given, {key_of(n, key.name), key_of(n, "shape")},
                             "must be absent with {}", words_for(c.bodies[n])) &&
             well;
    }
  }
  return well;
}

/// Reports the fault that a shape finds in its body, if any; true if all is well.
bool check(const ShapeFault& fault, std::size_t n, Findings& found) {
  if (fault.message == nullptr) return true;
  KeyNames keys;
  for (const std::string_view key : fault.keys)
    if (!key.empty()) keys.push_back(key.find('.') == key.npos ? key_of(n, key) : std::string(key));
  return !found.error_if(true, keys, "{}", fmt::format(fmt::runtime(fault.message), fault.number));
}

/// Checks keys of a body against each other; true if all is well.
bool check_sizes(const BodyConfig& body, std::size_t n, Findings& found) {
  bool well = true;
  BodyShapes::with(body.shape, [&]<class Shape>() {
    if constexpr (requires { Shape::fault(body); }) well = check(Shape::fault(body), n, found);
  });
  return well;
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
  const bool box = c.bodies[n].shape.is<shapes::Box>() && c.bodies[n].angle == 0;
  const bool blocks =
      (box || is_through(extent, c, 0)) && is_through(extent, c, 1) && is_through(extent, c, 2);
  found.error_if(blocks, {key_of(n, "shape"), "domain.size"},
                 "must leave water beside or above the body");
}

/// Checks a body against the periods of the domain: a place knows the image whose foot is nearest.
void check_periods(const Config& c, std::size_t n, Findings& found) {
  const BodyConfig& body = c.bodies[n];
  BodyShapes::with(body.shape, [&]<class Shape>() {
    if constexpr (requires { Shape::misfit(body, 1.0); })
      check(Shape::misfit(body, c.size[0]), n, found);
  });
}

/// Compares a body with the cells along the floor, and with the lowest rows upwards.
void check_resolution(const Config& c, std::size_t n, Findings& found) {
  const auto [nx, ny, nz] = c.fluid->cells;
  double cell = c.size[0] / nx;
  if (nz > 1) cell = std::max(cell, c.size[2] / nz);
  const double first = c.fluid->first_cell_height, row = first > 0 ? first : c.size[1] / ny;
  const Footprint foot = footprint(c.bodies[n]);
  const double across = foot.narrowest / cell, upwards = foot.height / row;
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
