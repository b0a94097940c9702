#include "src/app/new_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "src/base/errors.hpp"
#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/fluid/mesh.hpp"
#include "src/toml/lengths.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

constexpr double kGravity = 9.81, kWater = 1000, kViscosity = 1e-6;  // [m/s2, kg/m3, m2/s]

struct File {
  fs::path path;
  std::string text;
};

/// Cells along a length: a multiple of 4, at least 8, because the transforms of the pressure are
/// fast for small factors.
int cells_along(double length, double size) {
  return std::max(8, 4 * static_cast<int>(std::lround(length / size / 4)));
}

/// Numbers of a case, in SI units.
struct Plan {
  double d = 0, scale = 0;  // scale: d times the cube root of the count, some 0.7 heap radii
  double velocity = 0;
  std::array<double, 3> size{};
  std::array<int, 3> cells{};
  double uniform_height = 0, radius = 0, youngs_modulus = 0;
  double flow_end = 0, heap_end = 0, end = 0;
};

/// Number of rows that fill the height if they grow by 8 % at most.
int rows_for(double height, double first, double uniform_to) {
  RowSpacing rows{.height = height, .rows = 8, .first = first, .uniform_to = uniform_to};
  const auto too_few = [&] {  // rows that need not shrink, but grow too fast
    return rows.first * rows.rows < rows.height &&
           (!rows_fit(rows) || stretching_ratio(rows) > 1.08);
  };
  while (too_few()) ++rows.rows;
  return rows.rows;
}

/// Plan by the rules of docs/choosing.md; times and heaps in proportion to
/// configs/barchan-10k.toml.
Plan plan_of(const NewCase& asked, double d) {
  Plan p{.d = d, .scale = d * std::cbrt(asked.grains)};
  const double submerged = (asked.density / kWater - 1) * kGravity;
  p.size[1] = 6 * p.scale;
  constexpr double shields = 0.09;  // Shields number of the paper's flow
  const double wanted = bulk_velocity_of(std::sqrt(shields * submerged * d), p.size[1], kViscosity);
  p.velocity = asked.velocity.value_or(rounded(wanted, 2));
  const double wall_unit = kViscosity / friction_velocity(p.velocity, p.size[1], kViscosity);
  p.size = {std::max(23 * p.scale, 350 * wall_unit), std::max(6 * p.scale, 180 * wall_unit),
            std::max(9.5 * p.scale, 130 * wall_unit)};
  for (double& length : p.size) length = rounded(length, 2);
  p.uniform_height = rounded(std::max(0.5 * p.scale, 2 * d), 2);
  p.radius = rounded(1.4 * p.scale, 3);
  p.cells = {cells_along(p.size[0], 5 * d), rows_for(p.size[1], 0.65 * d, p.uniform_height),
             cells_along(p.size[2], 5 * d)};
  p.youngs_modulus = rounded(3.125e5 * (d / 2e-4) * (submerged / (1.5 * kGravity)), 3);
  p.flow_end = rounded(50 * p.size[1] / p.velocity, 2);
  const double fall = settling_velocity(d, asked.density / kWater, kViscosity, kGravity);
  p.heap_end = std::max(0.1, rounded(2 * p.scale / fall, 1));
  p.end = rounded(3 * std::pow(asked.grains, 2.0 / 3) * std::sqrt(d / submerged), 2);
  return p;
}

std::string mm(double metres) { return fmt::format("\"{:.4g} mm\"", 1e3 * metres); }

/// Sizes of grains: five classes about the mean, in the proportions of Table II of the paper.
std::string sizes_text(int grains, double d) {
  constexpr std::array<double, 5> ratio{0.75, 0.875, 1, 1.125, 1.25};
  constexpr std::array<double, 5> share{0.0227, 0.1359, 0, 0.1359, 0.0227};
  std::array<int, 5> count{};
  int rest = grains;
  for (std::size_t k = 0; k < 5; ++k) rest -= count[k] = static_cast<int>(share[k] * grains);
  count[2] = rest;
  std::vector<std::string> classes;
  for (std::size_t k = 0; k < 5; ++k) {
    if (count[k] > 0) classes.push_back(fmt::format("[{}, {}]", mm(ratio[k] * d), count[k]));
  }
  return fmt::format("[{}]", fmt::join(classes, ", "));
}

std::string flow_text(const std::string& name, const Plan& p) {
  return fmt::format(
      R"(# The flow that {0}.toml starts from: turbulent water without grains.

[case]
title = "Flow for {0}"

[time]
end = {1:g}                 # s: 50 times depth over velocity

[domain]
size = [{2}]    # along the flow, up, across

[fluid]
cells = [{3}]       # 5 grain diameters long and wide
first_cell_height = {4}   # 0.65 grain diameters
uniform_height = {5}      # above the crest: up to here all cells are as low
mean_velocity = {6:g}        # m/s

[initial]
fluid = "turbulent"
)",
      name, p.flow_end, fmt::join(std::array{mm(p.size[0]), mm(p.size[1]), mm(p.size[2])}, ", "),
      fmt::join(p.cells, ", "), mm(0.65 * p.d), mm(p.uniform_height), p.velocity);
}

std::string heap_text(const std::string& name, const NewCase& asked, const Plan& p) {
  return fmt::format(
      R"(# The heap that {0}.toml starts from: grains poured in still water.

[case]
title = "Heap for {0}"
base = "{0}-flow.toml"          # its box
without = ["fluid", "initial"]

[time]
end = {1:g}                 # s

[grains]
sizes = {2}
density = {3:g}              # kg/m3
youngs_modulus = {4:g}     # Pa: soft, for long steps; overlaps of 1 to 2 %
sliding_friction = 0.6
rolling_friction = 0.1       # a heap on a smooth floor needs some to stand

[grains.wall]
rolling_friction = 0.3

[grains.ambient]             # still water

[initial]
grains = {{ pour = {{ centre = [{5}, {6}], radius = {7} }} }}
)",
      name, p.heap_end, sizes_text(asked.grains, p.d), asked.density, p.youngs_modulus,
      mm(rounded(p.size[0] / 5, 2)), mm(p.size[2] / 2), mm(p.radius));
}

std::string dune_text(const std::string& name, const std::string& command, const Plan& p) {
  return fmt::format(
      R"(# A heap that becomes a barchan. Written by: {1}
#
#   ./barchan check {0}.toml    what follows from the numbers, and how long it takes
#   ./barchan run {0}.toml      first the flow and the heap, then the dune and its pictures
#
# Why these numbers: docs/choosing.md. All keys: ./barchan keys. One key for one run: --set grains.sliding_friction=0.3

[case]
title = "{0}"
base = ["{0}-flow.toml", "{0}-heap.toml"]     # box, mesh and flow of one, grains of the other
without = ["grains.ambient", "grains.wall"]   # still water and rough floor, of the heap alone

[time]
end = {2:g}                  # s
fluid_step = "auto"        # by the CFL number; check prints it
grain_step = "auto"        # by the stable step of contacts

[grains]
rolling_friction = 0.0

[initial]
fluid = "{0}-flow.toml"
grains = "{0}-heap.toml"

[output]                   # intervals in s
dune_interval = {3:g}
grains_interval = {4:g}
fields_interval = {5:g}
)",
      name, command, p.end, rounded(p.end / 100, 1), rounded(p.end / 40, 1), rounded(p.end / 4, 1));
}

std::string based_text(const std::string& name, const fs::path& from, const Config& base) {
  std::string text = fmt::format(
      "# {0}: what this file does not say is as in {1}. All keys: ./barchan keys\n\n"
      "[case]\ntitle = \"{0}\"\nbase = \"{1}\"\n\n[time]\nend = {2:g}\n",
      name, from.string(), base.time.end);
  if (base.fluid && base.fluid->mean_velocity.x != 0)
    text += fmt::format("\n[fluid]\nmean_velocity = {:g}\n", base.fluid->mean_velocity.x);
  if (base.grains)
    text +=
        fmt::format("\n[grains]\nsliding_friction = {:g}\nrolling_friction = {:g}\n",
                    base.grains->material.sliding_friction, base.grains->material.rolling_friction);
  return text;
}

double metres_of(const std::string& written) {
  Node length{written, {}};
  double metres = 0;
  if (is_in_diameters(length) || make_metres(length) || convert(length, metres) || metres < 1e-6 ||
      metres > 0.1)
    throw InputError(
        fmt::format("--diameter {}: must be a length from 1 um to 10 cm, as \"0.2 mm\"", written));
  return metres;
}

void refuse_what_is_there(const std::vector<File>& files) {
  std::error_code ignored;
  for (const File& file : files) {
    if (fs::exists(file.path, ignored))
      throw InputError(fmt::format("{} is there already: take another name", file.path.string()));
  }
}

/// Writes all files or none: a case that is refused leaves no file. Returns the case as it is read.
Case write_checked(const std::vector<File>& files) {
  refuse_what_is_there(files);
  const auto remove_all = [&] {
    std::error_code ignored;
    for (const File& file : files) fs::remove(file.path, ignored);
  };
  try {
    for (const File& file : files) {
      std::ofstream out(file.path);
      if (!(out << file.text).flush())
        throw InputError(fmt::format("cannot write {}", file.path.string()));
    }
    return load_case(files.back().path);
  } catch (...) {
    remove_all();
    throw;
  }
}

}  // namespace

std::string make_new_case(const NewCase& asked) {
  fs::path stem = asked.name;
  if (stem.extension() == ".toml") stem.replace_extension();
  const std::string name = stem.filename().string();
  const auto beside = [&](const std::string& ending) {
    return stem.parent_path() / (name + ending + ".toml");
  };
  std::vector<File> files;
  if (asked.from) {
    const fs::path folder = fs::absolute(stem).parent_path();
    const fs::path from = fs::absolute(*asked.from).lexically_normal().lexically_proximate(folder);
    files.push_back({beside(""), based_text(name, from, load_case(*asked.from).config)});
  } else {
    const Plan plan = plan_of(asked, metres_of(asked.diameter));
    const std::string command =
        fmt::format("./barchan new {} --grains {} --diameter \"{}\" --velocity {:g}", name,
                    asked.grains, asked.diameter, plan.velocity);
    files = {{beside("-flow"), flow_text(name, plan)},
             {beside("-heap"), heap_text(name, asked, plan)},
             {beside(""), dune_text(name, command, plan)}};
  }
  const Case made = write_checked(files);
  const std::string file = files.back().path.string();
  std::string said = fmt::format("wrote {}", file);
  if (files.size() > 1)
    said += fmt::format(", which starts from {} and {}", files[0].path.string(),
                        files[1].path.string());
  said += fmt::format(
      "\n  ./barchan check {0}    what follows from its numbers, and how long it takes\n"
      "  ./barchan run {0}      computes it and draws its pictures\n",
      file);
  for (const std::string& warning : case_warnings(made, made.sizes))
    said += fmt::format("warning: {}\n", warning);
  return said;
}

}  // namespace barchan
