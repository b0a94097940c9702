#include "src/fluid/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace barchan {

FrozenGrains::FrozenGrains(std::vector<FrozenGrain> grains, Real lx, Real lz, Real reach)
    : grains_(std::move(grains)), lx_(lx), lz_(lz), reach_(reach) {
  if (grains_.empty()) return;
  const auto height = [](const FrozenGrain& g) { return g.x.y; };
  const auto [low, high] = std::ranges::minmax(grains_, {}, height);
  r_max_ = std::ranges::max(grains_, {}, &FrozenGrain::r).r;
  const auto cells = [&](Real start, Real length) {
    Cells made{.n = std::max(1, static_cast<int>(length / (2 * r_max_))), .start = start};
    made.size = length > 0 ? length / made.n : 2 * r_max_;
    return made;
  };
  x_ = cells(0, lx), z_ = cells(0, lz);
  y_ = cells(low.x.y - r_max_, high.x.y - low.x.y + 2 * r_max_);
  const auto cell_of = [&](const FrozenGrain& g) {
    const int i = std::clamp(x_.of(g.x.x), 0, x_.n - 1), j = std::clamp(y_.of(g.x.y), 0, y_.n - 1);
    return static_cast<std::size_t>(i + x_.n * (j + y_.n * std::clamp(z_.of(g.x.z), 0, z_.n - 1)));
  };
  first_.assign(static_cast<std::size_t>(x_.n) * static_cast<std::size_t>(y_.n * z_.n) + 1, 0);
  for (const FrozenGrain& g : grains_) ++first_[cell_of(g) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<int> next = first_;
  entry_.resize(grains_.size());
  for (std::size_t n = 0; n < grains_.size(); ++n)
    entry_[static_cast<std::size_t>(next[cell_of(grains_[n])]++)] = static_cast<int>(n);
}

void FrozenGrains::look_in(int i, int j, int k, const Vec3& x, Bodies::Nearest& found) const {
  const auto wrapped = [](int n, int of) { return (n % of + of) % of; };
  const auto cell =
      static_cast<std::size_t>(wrapped(i, x_.n) + x_.n * (j + y_.n * wrapped(k, z_.n)));
  for (int e = first_[cell]; e < first_[cell + 1]; ++e) {
    const int n = entry_[static_cast<std::size_t>(e)];
    const FrozenGrain& g = grains_[static_cast<std::size_t>(n)];
    Vec3 s = x - g.x;
    s.x -= lx_ * std::round(s.x / lx_);
    s.z -= lz_ * std::round(s.z / lz_);
    const Real r = norm(s);
    if (r - g.r < found.surface.distance)
      found = {n, {r - g.r, r > 0 ? (1 / r) * s : Vec3{0, 1, 0}}};
  }
}

/// The cells at a distance of `ring` cells, each once: along x and z there are no more than n.
void FrozenGrains::look_around(int ring, const int (&cell)[3], const Vec3& x,
                               Bodies::Nearest& found) const {
  const auto low = [ring](const Cells& c) { return std::max(-ring, -((c.n - 1) / 2)); };
  const auto high = [ring](const Cells& c) { return std::min(ring, c.n / 2); };
  for (int dj = std::max(-ring, -cell[1]); dj <= std::min(ring, y_.n - 1 - cell[1]); ++dj)
    for (int dk = low(z_); dk <= high(z_); ++dk) {
      const bool edge = std::abs(dj) == ring || std::abs(dk) == ring;
      for (int di = low(x_); di <= high(x_); ++di)
        if (edge || std::abs(di) == ring)
          look_in(cell[0] + di, cell[1] + dj, cell[2] + dk, x, found);
    }
}

Bodies::Nearest FrozenGrains::nearest(const Vec3& x) const {
  Bodies::Nearest found{-1, {reach_, {0, 1, 0}}};
  if (grains_.empty()) return found;
  const int cell[] = {x_.of(x.x), y_.of(x.y), z_.of(x.z)};
  const Real size = std::min({x_.size, y_.size, z_.size});
  // Surfaces outside the rings so far are at least this far away.
  for (int ring = 0; found.surface.distance > (ring - 1) * size - r_max_; ++ring)
    look_around(ring, cell, x, found);
  return found;
}

Bodies::Nearest Solids::nearest(const Vec3& x) const {
  Bodies::Nearest found = bodies_.nearest(x);
  if (grains_.count() == 0) return found;
  const Bodies::Nearest grain = grains_.nearest(x);
  if (found.body < 0 || grain.surface.distance < found.surface.distance) {
    found = grain;
    if (grain.body >= 0) found.body += bodies_.n;
  }
  return found;
}

}  // namespace barchan
