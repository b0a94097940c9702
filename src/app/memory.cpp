#include "src/app/memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "kernels/coupling/markers.hpp"
#include "src/base/errors.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

// Bytes of a grain: arrays of a coupled case 700 (docs/performance.md), and the memory in which a
// restart file is gathered.
constexpr double kBytesPerGrain = 1000;

/// Bytes of a grain with the history of its contacts with bodies.
double bytes_per_grain(const Config& config) {
  if (config.bodies.empty()) return kBytesPerGrain;
  return kBytesPerGrain + 70 + 48 * static_cast<double>(config.bodies.size());
}

/// Bytes of the markers of a grain that moves in a resolved flow, and of the faces around it: three
/// boxes of numbers, and two vectors for each marker.
double bytes_of_markers(const Config& config, const std::vector<SizeClass>& sizes) {
  const auto& [nx, ny, nz] = config.fluid->cells;
  const double width = std::cbrt(config.size[0] * config.size[1] * config.size[2] /
                                 (static_cast<double>(nx) * ny * nz));
  double largest = 0;
  for (const SizeClass& size : sizes) largest = std::max(largest, size.diameter);
  const double radius = largest / 2 / width - kRetraction;
  if (radius < 0) return 0;
  return 8 * (3 * std::pow(std::floor(2 * (radius + kReachOfDelta)) + 1, 3) +
              6 * markers_on_sphere(radius));
}

/// Bytes of a cell: the state, about 30 numbers of work space and two complex transforms.
double bytes_per_cell() {
  int numbers = 30 + 4;
  for_each_fluid_field(FluidState(), [&](const auto& member, const FluidField&) {
    for_each_component(member, [&](const Field&, const char*) { ++numbers; });
  });
  return 8 * numbers;
}

}  // namespace

double fed_grains(const Config& config) {
  if (!config.grains || !config.grains->feed) return 0;
  const FeedConfig& feed = *config.grains->feed;
  return feed.rate * std::max(0.0, config.time.end - feed.start);
}

double memory_of_case(const Config& config, const std::vector<SizeClass>& sizes) {
  double bytes = 0;
  if (config.fluid) {
    const auto& [nx, ny, nz] = config.fluid->cells;
    bytes += bytes_per_cell() * nx * ny * nz;
  }
  if (config.grains) {
    double of_grain = bytes_per_grain(config);
    if (config.fluid && is_immersed(config.coupling, *config.grains))
      of_grain += bytes_of_markers(config, sizes);
    const std::vector<KindConfig> kinds = all_kinds(*config.grains);
    double n_grains = 0, n_spheres = 0;
    for (const SizeClass& size : sizes) {
      const auto count = static_cast<double>(size.count);
      n_grains += count;
      n_spheres += count * sphere_count(kinds[static_cast<std::size_t>(size.kind)].shape);
    }
    const double of_each = n_grains > 0 ? n_spheres / n_grains : 1;  // of grains fed, too
    bytes += of_grain * (n_spheres + of_each * fed_grains(config));
  }
  return bytes;
}

std::string memory_line(const Config& config, const std::vector<SizeClass>& sizes) {
  return fmt::format("  {:<24}about {:.0f} MB\n", "memory",
                     std::max(1.0, memory_of_case(config, sizes) / 1e6));
}

double memory_of_machine() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void check_memory(const Config& config, const std::vector<SizeClass>& sizes) {
  const double need = memory_of_case(config, sizes) / rank_count(MPI_COMM_WORLD);
  const double have = memory_of_machine();
  if (need <= have) return;
  throw InputError(fmt::format(
      "{}: this case needs about {:.3g} GB a rank, and this machine has {:.3g} GB: take fewer "
      "fluid.cells or grains, or more ranks on more machines",
      config.file.string(), need / 1e9, have / 1e9));
}

}  // namespace barchan
