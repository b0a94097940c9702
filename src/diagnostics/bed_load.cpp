#include "src/diagnostics/bed_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/diagnostics/bed_load.hpp"
#include "src/base/atomic_file.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

static_assert(sizeof(BedLoad::Layer) == 4 * sizeof(double));

/// Chooses the layers by the mean diameter.
void BedLoad::make_layers(const GrainState& grains) {
  const auto kin = host_copy(grains.kin);
  std::vector<double> counted{static_cast<double>(grains.n), 0};
  for (int g = 0; g < grains.n; ++g) counted[1] += 2 * kin(g).r;
  sum_over(grains.ranks, counted);
  if (counted[0] == 0) return;
  sums_.d = counted[1] / counted[0];
  const double n = std::round(layers_per_diameter * grid_.ly / sums_.d);
  layers_.resize(static_cast<std::size_t>(std::max(n, 1.0)));
}

std::vector<BedLoad::Layer> BedLoad::layers_now(const GrainState& grains) const {
  const auto kin = host_copy(grains.kin);
  const int n = static_cast<int>(layers_.size());
  const double h = layer_height(), per_volume = 1 / (grid_.lx * grid_.lz * h);
  std::vector<Layer> now(layers_.size());
  for (int g = 0; g < grains.n; ++g) {
    const GrainKinematics grain = kin(g);
    const double volume = 4 * std::numbers::pi / 3 * grain.r * grain.r * grain.r * per_volume;
    const double mass = grain.m * per_volume;
    share_among_layers(grain.x.y, grain.r, h, n, [&](int k, Real share) {
      Layer& layer = now[static_cast<std::size_t>(k)];
      layer.volume += share * volume;
      layer.flux += share * volume * grain.u.x;
      layer.mass += share * mass;
      layer.momentum += share * mass * grain.u.x;
    });
  }
  // Sum over ranks before adding: a restart then goes on with the same bits.
  all_reduce(grains.ranks, std::span(reinterpret_cast<double*>(now.data()), 4 * now.size()),
             MPI_SUM);
  return now;
}

std::vector<double> BedLoad::row_sums(const FluidState& fluid) const {
  const Kokkos::View<Real*> sums("bed load: rows", static_cast<std::size_t>(grid_.ny) + 1);
  const StressDivergence stress{grid_, fluid.u, fluid.nu_t, around_.viscosity};
  Kokkos::parallel_for("bed load: rows", Kokkos::TeamPolicy<>(grid_.ny + 1, Kokkos::AUTO),
                       SumRowMomentum{grid_, fluid.u.x, fluid.alpha_f, stress, sums});
  const auto host = host_copy(sums);
  std::vector<double> rows(host.data(), host.data() + host.size());
  all_reduce(ranks_of(grid_), std::span(rows), MPI_SUM);
  const double faces = static_cast<double>(grid_.nx_all) * grid_.nz_all;
  for (double& row : rows) row *= around_.fluid_density / faces;
  return rows;
}

std::vector<double> BedLoad::momentum_now(const std::vector<Layer>& grains,
                                          const std::vector<double>& rows) const {
  const auto faces = host_copy(grid_.y_face_);  // the first entry is a ghost face
  const double h = layer_height();
  std::vector<double> momentum(grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const double from = static_cast<double>(k) * h, to = from + h;
    momentum[k] = grains[k].momentum * h;
    if (around_.fluid_in_grains) momentum[k] -= around_.fluid_density * grains[k].flux * h;
    for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
      const double inside = std::min(to, faces(j + 2)) - std::max(from, faces(j + 1));
      if (inside > 0) momentum[k] += inside * rows[j];
    }
  }
  return momentum;
}

void BedLoad::sample(const FluidState& fluid, const GrainState& entries, double t) {
  const GrainState grains = whole_grains(entries);
  if (sums_.d == 0) make_layers(grains);
  if (sums_.d == 0) return;
  const std::vector<Layer> now = layers_now(grains);
  const std::vector<double> rows = row_sums(fluid);
  last_momentum_ = momentum_now(now, rows);
  sums_.end = t;
  if (sums_.n_samples == 0) first_momentum_ = last_momentum_, sums_.start = t;
  for (std::size_t k = 0; k < now.size(); ++k) {
    layers_[k].volume += now[k].volume;
    layers_[k].flux += now[k].flux;
    layers_[k].mass += now[k].mass;
    layers_[k].momentum += now[k].momentum;
  }
  sums_.gradient += around_.fluid_density * fluid.drive.x;
  sums_.top_stress += rows.back();
  sums_.n_samples += 1;
}

std::vector<BedLoadRecord> BedLoad::table() const {
  std::vector<BedLoadRecord> lines(layers_.size());
  if (lines.empty()) return lines;
  const double h = layer_height(), g = -around_.gravity.y, n = sums_.n_samples;
  const double seconds = sums_.end - sums_.start;
  PullFromAbove pull{
      .top = sums_.top_stress / n, .gradient = sums_.gradient / n, .gravity_x = around_.gravity.x};
  BedLoadRecord bed{.d = sums_.d,
                    .t_start = sums_.start,
                    .t_end = sums_.end,
                    .n_samples = static_cast<std::int64_t>(n)};
  // At the upper face of each layer, from the top down.
  std::vector<double> mass_above(lines.size());
  std::vector<PullFromAbove> from_above(lines.size());
  double volume = 0, mass = 0, mass_flux = 0;
  const auto go_down = [&](std::size_t k, double share) {
    PullFromAbove below = from_above[k];
    below.height += share * h;
    below.submerged +=
        share * h * (layers_[k].mass - around_.fluid_density * layers_[k].volume) / n;
    if (seconds > 0)
      below.momentum_gained += share * (last_momentum_[k] - first_momentum_[k]) / seconds;
    return below;
  };
  for (std::size_t k = lines.size(); k-- > 0;) {
    const Layer& layer = layers_[k];
    from_above[k] = pull, mass_above[k] = mass;
    const PullFromAbove middle = go_down(k, 0.5);
    lines[k].y = (static_cast<double>(k) + 0.5) * h;
    lines[k].solid_fraction = layer.volume / n;
    lines[k].grain_velocity = layer.volume > 0 ? layer.flux / layer.volume : 0;
    lines[k].flux_density = layer.flux / n;
    lines[k].particle_pressure = particle_pressure(g, middle.submerged);
    lines[k].total_stress = middle.stress();
    pull = go_down(k, 1);
    volume += h * layer.volume / n, mass += h * layer.mass / n;
    bed.q += h * layer.flux / n, mass_flux += h * layer.momentum / n;
  }
  const double along =
      bed.q < 0 ? -1 : 1;  // grains that go upstream make the energy in their sense
  std::size_t peak = lines.size();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    // Layers beside this one, as far as there are grains in them.
    const std::size_t lower = k > 0 && layers_[k - 1].volume > 0 ? k - 1 : k;
    const std::size_t upper = k + 1 < lines.size() && layers_[k + 1].volume > 0 ? k + 1 : k;
    if (layers_[k].volume > 0 && upper > lower)
      lines[k].shear_rate = (lines[upper].grain_velocity - lines[lower].grain_velocity) /
                            (h * static_cast<double>(upper - lower));
    lines[k].production =
        fluctuation_production(lines[k].particle_pressure, along * lines[k].shear_rate);
    const double largest = peak < lines.size() ? lines[peak].production : 0;
    if (lines[k].production > largest) peak = k;
  }
  const TransportScales scales{.excess = mass / volume - around_.fluid_density,
                               .fluid_density = around_.fluid_density,
                               .g = g,
                               .d = sums_.d};
  bed.q_star = bed.q / scales.flux();
  bed.bed_surface = bed.bed_stress = bed.shields = bed.load = bed.load_velocity =
      std::numeric_limits<double>::quiet_NaN();
  if (peak < lines.size()) {
    const bool inside = peak > 0 && peak + 1 < lines.size();
    const double offset = inside ? peak_offset(lines[peak - 1].production, lines[peak].production,
                                               lines[peak + 1].production)
                                 : 0;
    bed.bed_surface = lines[peak].y + offset * h;
    bed.bed_stress = go_down(peak, 0.5 - offset).stress();
    bed.shields = bed.bed_stress / scales.stress();
    bed.load = mass_above[peak] + (0.5 - offset) * h * layers_[peak].mass / n;
    bed.load_velocity = mass_flux / bed.load;
  }
  for (BedLoadRecord& line : lines) {
    BedLoadRecord all = bed;
    all.y = line.y, all.solid_fraction = line.solid_fraction;
    all.grain_velocity = line.grain_velocity, all.flux_density = line.flux_density;
    all.particle_pressure = line.particle_pressure, all.shear_rate = line.shear_rate;
    all.production = line.production, all.total_stress = line.total_stress;
    line = all;
  }
  return lines;
}

void BedLoad::write(const std::filesystem::path& file) const {
  const std::vector<BedLoadRecord> lines = table();
  if (lines.empty() || rank_of(grid_) != 0) return;
  std::string text = kBedLoadTable.header() + "\n";
  for (const BedLoadRecord& line : lines) text += kBedLoadTable.line(line);
  write_atomically(file, text);
}

void BedLoad::save(CheckpointWriter& file) const {
  if (sums_.n_samples == 0) return;
  std::vector<double> numbers{sums_.d,   sums_.n_samples, sums_.start,
                              sums_.end, sums_.gradient,  sums_.top_stress};
  const auto* layers = reinterpret_cast<const double*>(layers_.data());
  numbers.insert(numbers.end(), layers, layers + 4 * layers_.size());
  for (const auto& momentum : {first_momentum_, last_momentum_})
    numbers.insert(numbers.end(), momentum.begin(), momentum.end());
  file.array("statistics/bed_load", std::span<const double>(numbers));
}

void BedLoad::load(const CheckpointReader& file) {
  if (!file.has("statistics/bed_load")) return;
  const auto numbers = file.array<double>("statistics/bed_load");
  if (numbers.size() <= 6 || numbers.size() % 6 != 0 || !(numbers[0] > 0))
    file.fail("statistics/bed_load has not what bedload.csv is made of");
  sums_ = {.d = numbers[0],
           .n_samples = numbers[1],
           .start = numbers[2],
           .end = numbers[3],
           .gradient = numbers[4],
           .top_stress = numbers[5]};
  const std::size_t n = (numbers.size() - 6) / 6;
  layers_.resize(n);
  const auto begin = numbers.begin() + 6, momentum = begin + static_cast<std::ptrdiff_t>(4 * n);
  std::copy(begin, momentum, reinterpret_cast<double*>(layers_.data()));
  first_momentum_.assign(momentum, momentum + static_cast<std::ptrdiff_t>(n));
  last_momentum_.assign(momentum + static_cast<std::ptrdiff_t>(n), numbers.end());
}

}  // namespace barchan
