#include "perf/heaps.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "perf/cases.hpp"
#include "perf/options.hpp"
#include "src/base/atomic_file.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

int grain_count(const std::string& name) {
  if (name == "heap_10k") return options().tiny ? 500 : 10000;
  return options().tiny ? 1000 : 100000;
}

/// Pours grains of the paper's Table II, in proportion, on the lattice that heaps settle from.
void pour(Config& c, int n) {
  const auto part = [n](std::int64_t of_100k) { return of_100k * n / 100000; };
  c.grains->sizes = {{1.5e-4, part(2276)},
                     {1.75e-4, part(13592)},
                     {2e-4, part(68267)},
                     {2.25e-4, part(13591)},
                     {2.5e-4, part(2274)}};
  c.initial.pour.emplace();
  c.initial.pour->radius = 0.013 * std::cbrt(n / 1e5);
  c.initial.pour->centre = {0.04, 0.05};
}

InitialGrains read_back(const GrainState& grains) {
  InitialGrains list;
  const auto kin = host_copy(grains.kin);
  const auto id = host_copy(grains.id);
  for (int g = 0; g < grains.n; ++g) {
    list.id.push_back(id(g));
    list.diameter.push_back(2 * kin(g).r);
    list.x.push_back(kin(g).x);
    list.u.push_back({});
    list.omega.push_back({});
  }
  return list;
}

InitialGrains settle(const std::string& name) {
  CaseSpec spec = grains_alone("settling", "", 0);
  Config& config = spec.config;
  config.size = {0.4, 0.025, 0.1};
  pour(config, grain_count(name));
  const int n_steps = options().tiny ? 40 : 200;  // steps of 2.5e-4 s
  if (!options().tiny) fmt::print(stderr, "settling {}, once\n", name);
  SystemState state = make_initial_state(config, {});
  CoupledStep step(config, state);
  step.start(state);
  for (int n = 0; n < n_steps; ++n) step.advance(state);
  return read_back(*state.grains);
}

void write_csv(const InitialGrains& grains, const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::string text = "id,diameter,x,y,z\n";
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3& x = grains.x[g];
    fmt::format_to(std::back_inserter(text), "{},{:.6g},{:.10g},{:.10g},{:.10g}\n", grains.id[g],
                   grains.diameter[g], x.x, x.y, x.z);
  }
  write_atomically(file, text);
}

/// Rows of grains with a gap of a diameter between them, off the floor.
InitialGrains spread_out(int n) {
  InitialGrains grains;
  const double d = 2e-4, pitch = 2 * d;
  const int side = static_cast<int>(std::ceil(std::cbrt(n)));
  for (int g = 0; g < n; ++g) {
    grains.id.push_back(g + 1);
    grains.diameter.push_back(d);
    const int row = g / side % side, layer = g / side / side;
    grains.x.push_back({0.01 + pitch * (g % side), pitch * (1 + layer), 0.005 + pitch * row});
    grains.u.push_back({});
    grains.omega.push_back({});
  }
  return grains;
}

Heap make_heap(const std::string& name) {
  if (name == "lattice") return {spread_out(grain_count(name)), "lattice"};
  const bool keeps = !options().tiny && !options().heaps.empty();
  const std::filesystem::path file = options().heaps / (name + ".csv");
  if (keeps && std::filesystem::exists(file)) return {read_grains(file), file.string()};
  Heap heap{settle(name), "settled here"};
  if (keeps) write_csv(heap.grains, file);
  return heap;
}

}  // namespace

Heap settled_heap(const std::string& name) {
  static std::map<std::string, Heap> heaps;
  const auto known = heaps.find(name);
  return known != heaps.end() ? known->second : heaps.emplace(name, make_heap(name)).first->second;
}

void move_into(InitialGrains& grains, const std::array<double, 3>& domain) {
  double x = 0, z = 0;
  for (const Vec3& at : grains.x) x += at.x, z += at.z;
  const auto n = static_cast<double>(grains.size());
  const double to_x = std::max(0.02, 0.1 * domain[0]) - x / n, to_z = domain[2] / 2 - z / n;
  for (Vec3& at : grains.x) at.x += to_x, at.z += to_z;
}

}  // namespace barchan
