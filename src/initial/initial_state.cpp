#include "src/initial/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "src/base/errors.hpp"
#include "src/case/derived.hpp"
#include "src/case/grain_checks.hpp"
#include "src/case/load.hpp"
#include "src/case/validate.hpp"
#include "src/fluid/domain.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/grain_kinds.hpp"
#include "src/grains/kinds.hpp"
#include "src/initial/crater.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/initial/map_flow.hpp"
#include "src/initial/overlaps.hpp"
#include "src/initial/pour.hpp"
#include "src/initial/window.hpp"
#include "src/restart/state_file.hpp"

namespace barchan {

namespace {

/// Case that computed a flow. A flow in another domain is refused: it would be taken for one in
/// this. A file that is not ours says nothing about its case: its arrays must speak for themselves.
Config case_of_flow(const Config& config, const CheckpointReader& file) {
  const std::string resolved = file.provenance().config;
  if (resolved.empty()) return config;
  Config other = config_as_written(resolved, file.path());
  for (const Finding& f : check_start(config, other, true)) {
    throw InputError(fmt::format("{}: as initial.fluid it {}", file.path().string(), f.message));
  }
  return other;
}

bool same_mesh(const FluidCase& a, const FluidCase& b) {
  return a.fluid.cells == b.fluid.cells && a.row_faces == b.row_faces;
}

/// Copies a flow on the same mesh bit for bit; interpolates one on another mesh.
void read_flow(const SettledCase& the_case, const CheckpointReader& file, FluidState& fluid) {
  const FluidCase other = case_of_flow(the_case.config, file);
  const auto& window = the_case.config.initial.window;
  if (!window && same_mesh(the_case.fluid(), other)) return load_flow(file, fluid);
  FluidState whole = make_fluid_state(make_grid(other));
  load_flow(file, whole);
  if (window) return map_window(the_case.fluid(), other.fluid, *window, whole, fluid);
  map_flow(the_case.fluid(), whole, fluid);
}

FluidState initial_fluid(const SettledCase& the_case, const std::filesystem::path& file,
                         const Decomposition* pencils) {
  FluidState fluid = make_fluid_state(make_grid(the_case.fluid(), pencils));
  if (!file.empty()) {
    const CheckpointReader flow(file, pencils ? pencils->all() : MPI_COMM_SELF);
    read_flow(the_case, flow, fluid);
    fluid.time = 0;
    // The precursor's fluid step may be another one, and grains now push the fluid aside.
    fluid.has_history = false;
    return fluid;
  }
  StartFlows::each([&]<class Flow>() {
    if (the_case.config.initial.starts_as<Flow>()) set_flow(Flow{}, the_case, fluid);
  });
  return fluid;
}

/// Sizes of the smallest and the largest grain of each kind.
std::vector<SizeClass> extreme_sizes(const InitialGrains& grains) {
  std::map<int, std::pair<double, double>> of_kind;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double d = grains.diameter[g];
    auto& [least, most] = of_kind.try_emplace(grains.kind_of(g), d, d).first->second;
    least = std::min(least, d), most = std::max(most, d);
  }
  std::vector<SizeClass> sizes;
  for (const auto& [kind, extremes] : of_kind)
    for (const double d : {extremes.first, extremes.second})
      sizes.push_back({.diameter = d, .count = 1, .kind = kind});
  return sizes;
}

/// Refuses grains that the domain does not hold.
void check_inside(const InitialGrains& grains, const Config& config, const std::string& source) {
  const auto [lx, ly, lz] = config.size;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3& x = grains.x[g];
    const double r = grains.diameter[g] / 2;
    if (x.x >= 0 && x.x <= lx && x.y >= -r && x.y <= ly && x.z >= 0 && x.z <= lz) continue;
    const bool far_out = norm(x) > 10 * (lx + ly + lz);
    throw InputError(
        fmt::format("{}: grain {} at ({:.6g}, {:.6g}, {:.6g}) m lies outside the domain, 0 to "
                    "({:.6g}, {:.6g}, {:.6g}) m (domain.size){}",
                    source, grains.id[g], x.x, x.y, x.z, lx, ly, lz,
                    far_out ? "; lengths are in m, not mm" : ""));
  }
}

PeriodicBox box_of(const Config& config) {
  const bool z = config.grains->boundary_z == GrainBoundaryZ::periodic;
  return {is_periodic_x(config) ? config.size[0] : 0, z ? config.size[2] : 0};
}

/// Refuses two grains at one place: what they would do to each other has no direction.
void check_apart(const InitialGrains& grains, const PeriodicBox& box, const std::string& source) {
  std::vector<std::size_t> order(grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t g) {
    const Vec3 x = box.wrap(grains.x[g]);
    return std::array{x.x, x.y, x.z};
  };
  std::ranges::sort(order, {}, place);
  const auto same = std::ranges::adjacent_find(order, {}, place);
  if (same == order.end()) return;
  const Vec3& x = grains.x[*same];
  throw InputError(fmt::format("{}: grains {} and {} are at one place, ({:.6g}, {:.6g}, {:.6g}) m",
                               source, grains.id[*same], grains.id[*(same + 1)], x.x, x.y, x.z));
}

/// Refuses numbers beyond those that spheres of clumps can have.
void check_numbers(const Config& config, const InitialGrains& grains, const std::string& source) {
  if (!has_clumps(*config.grains)) return;
  const auto [least, most] = std::ranges::minmax(grains.id);
  if (least >= 0 && most <= kLargestNumber) return;
  throw InputError(fmt::format("{}: a grain has the id {}: with clumps it must be from 0 to {}",
                               source, least < 0 ? least : most, kLargestNumber));
}

}  // namespace

namespace {

/// Kind with this number: tables of the Python package have the numbers of the kinds.
std::string name_of_number(const std::string& name, const GrainConfig& config) {
  const std::vector<std::string> names = names_of_kinds(config);
  const bool digit = name.size() == 1 && name.front() >= '0' && name.front() <= '9';
  const std::size_t number = digit ? static_cast<std::size_t>(name.front() - '0') : names.size();
  return kind_of_name(config, name) < 0 && number < names.size() ? names[number] : name;
}

/// Refuses grains of kinds with other shapes than those of the case. `ours`: index here of each of
/// their kinds; empty: the same.
void check_shapes_of_kinds(const InitialGrains& grains, const std::vector<int>& ours,
                           const GrainConfig& config, const std::string& source) {
  const std::set<std::uint8_t> used(grains.kind.begin(), grains.kind.end());
  for (std::size_t kind = 0; kind < grains.shapes.size(); ++kind) {
    if (!used.contains(static_cast<std::uint8_t>(kind)) && !(used.empty() && kind == 0)) continue;
    const int here = kind < ours.size() ? std::max(ours[kind], 0) : static_cast<int>(kind);
    if (static_cast<std::size_t>(here) >= names_of_kinds(config).size()) continue;
    if (const std::string fault = unlike_shape(config, here, grains.shapes[kind]); !fault.empty())
      throw InputError(fmt::format("{}: it must {}", source, fault));
  }
}

}  // namespace

void take_kinds(InitialGrains& grains, const GrainConfig& config, const std::string& source) {
  std::vector<std::string> theirs = grains.kind_names;
  if (grains.kind.empty()) theirs = {""};
  for (std::string& name : theirs) name = name_of_number(name, config);
  if (const std::string problem = unknown_kinds(config, theirs); !problem.empty())
    throw InputError(fmt::format("{}: it must {}", source, problem));
  const std::size_t n_kinds = names_of_kinds(config).size();
  // index of each of their kinds here; without names these are in the case's order
  std::vector<int> ours;
  for (const std::string& name : theirs) ours.push_back(kind_of_name(config, name));
  check_shapes_of_kinds(grains, ours, config, source);
  for (std::uint8_t& kind : grains.kind) {
    if (kind >= (theirs.empty() ? n_kinds : ours.size()))
      throw InputError(fmt::format("{}: it holds grains of more kinds than it names", source));
    if (!theirs.empty()) kind = static_cast<std::uint8_t>(ours[kind]);
  }
  if (n_kinds == 1) grains.kind.clear();  // as with grains that are poured
}

void check_sizes(const std::vector<SizeClass>& sizes, const Config& config,
                 const std::string& source) {
  for (const Finding& f : check_grain_sizes(config, sizes)) {
    if (f.severity != Finding::Severity::error) continue;
    throw InputError(fmt::format("{}: with these grains {} {}", source, f.keys.front(), f.message));
  }
}

void check_free_ids(const Config& config, std::int64_t last, const std::string& source) {
  constexpr std::int64_t most_of_spheres = std::numeric_limits<std::int64_t>::max();
  const std::int64_t most = (has_clumps(*config.grains) ? kLargestNumber : most_of_spheres) / 2;
  if (!config.grains->feed || last <= most) return;
  throw InputError(
      fmt::format("{}: a grain has the id {}: with [grains.feed] it must be at most {}, for grains "
                  "that come in have the ids after it",
                  source, last, most));
}

std::string source_of_grains(const Config& config, const std::filesystem::path& file) {
  if (config.initial.pour) return "initial.grains.pour";
  return config.initial.heaps.empty() ? file.string() : "initial.heap";
}

InitialGrains checked_grains(const SettledCase& the_case, const std::filesystem::path& file) {
  const Config& config = the_case.config;
  const std::vector<HeapConfig>& heaps = the_case.heaps;
  InitialGrains grains =
      heaps.empty() ? read_grains(file) : pour_grains(heaps, config.size, the_case.bodies());
  const std::string source = source_of_grains(config, file);
  if (grains.size() == 0) throw InputError(source + " holds no grains");
  grains.last_id = std::max(grains.last_id, std::ranges::max(grains.id));
  check_free_ids(config, grains.last_id, source);
  check_numbers(config, grains, source);
  if (heaps.empty()) take_kinds(grains, *config.grains, source);
  check_sizes(extreme_sizes(grains), config, source);
  if (config.initial.window) cut_to_window(config, box_of(config), grains);
  wrap(grains, config);
  check_inside(grains, config, source);
  cut_craters(config.initial.craters, grains);
  if (grains.size() == 0) throw InputError("initial.crater leaves no grains");
  check_apart(grains, box_of(config), source);
  const InitialGrains spheres = spheres_at_start(grains, config);
  check_outside_bodies(spheres, the_case.grains(), source);
  if (!config.grains->frozen)
    check_overlaps(spheres, box_of(config), config.grains->max_overlap, source);
  return grains;
}

InitialGrains spheres_at_start(const InitialGrains& grains, const Config& config) {
  const auto realisation = static_cast<std::uint64_t>(config.initial.realisation - 1);
  return as_spheres(grains, *config.grains, config.initial.seed + realisation);
}

SystemState make_initial_state(const SettledCase& the_case, const InitialFiles& files,
                               MPI_Comm ranks, const Decomposition* pencils) {
  const Config& config = the_case.config;
  SystemState state;
  if (config.fluid) state.fluid = initial_fluid(the_case, files.fluid, pencils);
  if (config.grains) {
    const InitialGrains grains = spheres_at_start(checked_grains(the_case, files.grains), config);
    state.grains = make_grain_state(grains, densities_of(*config.grains), ranks);
  }
  return state;
}

}  // namespace barchan
