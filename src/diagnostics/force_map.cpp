#include "src/diagnostics/force_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/atomic_file.hpp"

namespace barchan {

void ForceMap::sample(double t, GrainCloud grains, std::span<const Vec3> force) {
  const std::vector<DuneRecord> dunes = find_dunes(grains, domain_).records;
  if (dunes.empty()) return;
  const DuneRecord& dune = dunes.front();
  if (step_ == 0) {  // kept: grains that leave must not move the bins
    double sum = 0;
    for (const GrainSample& grain : grains) sum += grain.d;
    step_ = bin_diameters * sum / static_cast<double>(grains.size());
    start_ = t;
  }
  end_ = t;
  for (std::size_t g = 0; g < force.size(); ++g) {
    const double x = domain_.nearest_x(grains[g].x.x - dune.cx);
    const double z = domain_.nearest_z(grains[g].x.z - dune.cz);
    const double turns = std::atan2(-z, x) / (2 * std::numbers::pi);
    const auto a = static_cast<std::size_t>((turns - std::floor(turns)) * n_angles) % n_angles;
    const double r = std::hypot(x, z) / step_;
    if (!(r < n_radii)) continue;
    Bin& bin = bins_[a * n_radii + static_cast<std::size_t>(r)];
    bin.n += 1;
    bin.force += force[g];
  }
}

void ForceMap::write(const std::filesystem::path& file) const {
  if (step_ == 0) return;
  std::string text = kForceMapTable.header() + "\n";
  const double angle = 360.0 / n_angles;
  for (int b = 0; b < n_angles * n_radii; ++b) {
    const Bin& bin = bins_[static_cast<std::size_t>(b)];
    if (bin.n == 0) continue;
    const int a = b / n_radii, r = b % n_radii;
    const Vec3 mean = (1 / bin.n) * bin.force;
    text += kForceMapTable.line({.r_min = r * step_,
                                 .r_max = (r + 1) * step_,
                                 .phi_min = a * angle,
                                 .phi_max = (a + 1) * angle,
                                 .n = static_cast<std::int64_t>(bin.n),
                                 .x = mean.x,
                                 .y = mean.y,
                                 .z = mean.z,
                                 .t_start = start_,
                                 .t_end = end_});
  }
  write_atomically(file, text);
}

static_assert(sizeof(ForceMap::Bin) == 4 * sizeof(double));

void ForceMap::save(CheckpointWriter& file) const {
  std::vector<double> numbers{step_, start_, end_};
  const auto* sums = reinterpret_cast<const double*>(bins_.data());
  numbers.insert(numbers.end(), sums, sums + 4 * bins_.size());
  file.array("statistics/force_map", std::span<const double>(numbers));
}

void ForceMap::load(const CheckpointReader& file) {
  if (!file.has("statistics/force_map")) return;
  const auto numbers = file.array<double>("statistics/force_map");
  if (numbers.size() != 3 + 4 * bins_.size()) return;  // other bins: begin anew
  step_ = numbers[0], start_ = numbers[1], end_ = numbers[2];
  std::copy(numbers.begin() + 3, numbers.end(), reinterpret_cast<double*>(bins_.data()));
}

}  // namespace barchan
