// The 29 points against the exact overlap of sphere and cell, and the smoothing kernel.
#include <algorithm>
#include <map>
#include <numbers>

#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using Index = std::array<int, 3>;
using Shares = std::map<Index, double>;  // by cell, of the grain's volume

// --- Exact volume that a sphere shares with an axis-parallel box.

/// Area of the disc of radius r around the origin with x < a and y < b.
double quarter_disc(double a, double b, double r) {
  if (a <= -r || b <= -r) return 0;
  a = std::min(a, r);
  b = std::min(b, r);
  // int over x of min(b, sqrt(r^2 - x^2)) + sqrt(r^2 - x^2) from -r to a, the integrand not below
  // 0.
  const auto half_disc = [&](double x) {  // antiderivative of sqrt(r^2 - x^2)
    return (x * std::sqrt(std::max(0.0, r * r - x * x)) +
            r * r * std::asin(std::clamp(x / r, -1.0, 1.0))) /
           2;
  };
  const double edge = std::sqrt(std::max(0.0, r * r - b * b));
  const auto between = [&](double low, double high, double chords, double height) {
    low = std::clamp(low, -r, a);
    high = std::clamp(high, -r, a);
    return high > low ? chords * (half_disc(high) - half_disc(low)) + height * (high - low) : 0;
  };
  if (b >= 0) {
    return between(-r, -edge, 2, 0) + between(-edge, edge, 1, b) + between(edge, r, 2, 0);
  }
  return between(-edge, edge, 1, b);
}

struct Box {
  std::array<double, 3> low, high;
};

/// Slices across z are exact; between the heights at which a slice changes its shape they are
/// integrated by Gauss-Legendre in t with z = middle + half sin(pi t/2), smooth at the ends.
double sphere_box_overlap(const std::array<double, 3>& centre, double radius, const Box& box) {
  const double x0 = box.low[0] - centre[0], x1 = box.high[0] - centre[0];
  const double y0 = box.low[1] - centre[1], y1 = box.high[1] - centre[1];
  const double z0 = std::max(box.low[2] - centre[2], -radius);
  const double z1 = std::min(box.high[2] - centre[2], radius);
  if (z1 <= z0) return 0;
  std::vector<double> at = {z0, z1};
  for (const double x : {x0, x1, 0.0})
    for (const double y : {y0, y1, 0.0}) {
      const double rest = radius * radius - x * x - y * y;
      if (rest <= 0) continue;
      for (const double z : {-std::sqrt(rest), std::sqrt(rest)})
        if (z > z0 && z < z1) at.push_back(z);
    }
  std::sort(at.begin(), at.end());
  const auto slice = [&](double z) {
    const double r = std::sqrt(std::max(0.0, radius * radius - z * z));
    return quarter_disc(x1, y1, r) - quarter_disc(x0, y1, r) - quarter_disc(x1, y0, r) +
           quarter_disc(x0, y0, r);
  };
  constexpr std::array<double, 4> node = {0.1834346424956498, 0.5255324099163290,
                                          0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight = {0.3626837833783620, 0.3137066458778873,
                                            0.2223810344533745, 0.1012285362903763};
  double sum = 0;
  for (std::size_t n = 0; n + 1 < at.size(); ++n) {
    const double middle = (at[n] + at[n + 1]) / 2, half = (at[n + 1] - at[n]) / 2;
    for (std::size_t q = 0; q < node.size(); ++q)
      for (const double t : {-node[q], node[q]}) {
        const double angle = std::numbers::pi / 2 * t;
        sum += weight[q] * half * std::numbers::pi / 2 * std::cos(angle) *
               slice(middle + half * std::sin(angle));
      }
  }
  return sum;
}

// --- The code against it.

constexpr int kCells = 6;  // cubic cells of edge one in each direction

struct Cells {
  test::HostGrid grid{make_grid(kCells, kCells, kCells, kCells, row_faces({kCells, kCells, 0}))};
  DepositStencil stencil = deposit_stencil_in(grid.ref(), PointModel::divided, true);

  /// Shares by the code.
  Shares deposited(const Vec3& x, double r) const {
    const GrainCells cells = stencil({.x = x, .r = r, .u = {}, .m = 1, .omega = {}});
    Shares s;
    for (int q = 0; q < cells.n; ++q) {
      const CellIndex& c = cells.cell[q];
      s[{c.i, c.j, c.k}] += cells.weight(q);
    }
    return s;
  }
};

/// Cell that takes the volume of a cell outside of the domain: images along x and z, the mirror in
/// y.
Index fold(const Index& c) {
  const auto wrap = [](int i) { return (i % kCells + kCells) % kCells; };
  const int j = c[1] < 0 ? -1 - c[1] : c[1] >= kCells ? 2 * kCells - 1 - c[1] : c[1];
  return {wrap(c[0]), j, wrap(c[2])};
}

Shares exact(const Vec3& x, double r) {
  Shares s;
  const auto first = [&](double at) { return static_cast<int>(std::floor(at - r)); };
  const auto last = [&](double at) { return static_cast<int>(std::floor(at + r)); };
  for (int i = first(x.x); i <= last(x.x); ++i)
    for (int j = first(x.y); j <= last(x.y); ++j)
      for (int k = first(x.z); k <= last(x.z); ++k) {
        const Box box{{double(i), double(j), double(k)}, {i + 1., j + 1., k + 1.}};
        s[fold({i, j, k})] += sphere_box_overlap({x.x, x.y, x.z}, r, box) / test::volume_of(2 * r);
      }
  return s;
}

/// Hyperslab of the grain that lies in wrong cells.
double misplaced(const Shares& a, const Shares& b) {
  double sum = 0;
  for (const auto& [cell, share] : a)
    sum += std::abs(share - (b.contains(cell) ? b.at(cell) : 0)) / 2;
  for (const auto& [cell, share] : b) sum += a.contains(cell) ? 0 : share / 2;
  return sum;
}

/// Shares of whole rows.
Shares by_row(const Shares& shares) {
  Shares s;
  for (const auto& [c, share] : shares) s[{0, c[1], 0}] += share;
  return s;
}

std::vector<Vec3> random_places(int n, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> places;
  for (int q = 0; q < n; ++q) places.push_back({uniform(engine), uniform(engine), uniform(engine)});
  return places;
}

/// Against whole sphere, octant, box and cap; the quadrature's own error is far below the 29
/// points'.
TEST(VoidFractionOverlap, TheExactOverlapIsExact) {
  const double r = 0.7, half = test::volume_of(2 * r) / 2;
  const double h = r - 0.3;  // height of a cap
  const auto expect_overlap = [&](const Box& box, double volume) {
    EXPECT_NEAR(sphere_box_overlap({0, 0, 0}, r, box), volume, 2e-6);
  };
  expect_overlap({{-1, -1, -1}, {1, 1, 1}}, 2 * half);
  expect_overlap({{0, 0, 0}, {1, 1, 1}}, half / 4);
  expect_overlap({{-0.2, -0.1, -0.3}, {0.2, 0.1, 0.3}}, 0.4 * 0.2 * 0.6);
  expect_overlap({{0.3, -1, -1}, {1, 1, 1}}, std::numbers::pi * h * h * (3 * r - h) / 3);
  for (const Vec3& x : random_places(50, 1)) {
    double sum = 0;
    for (const auto& [cell, share] : exact(3 * x, r)) sum += share;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

/// Error of the fraction: only grains that a cell face cuts can be wrong, a share of d/h per
/// direction, so it falls as d/h.
TEST(VoidFractionOverlap, ErrorFallsAsDiameterOverCellSize) {
  const Cells cells;
  const auto places = random_places(2000, 2);
  double last = 0;
  for (const double ratio : {1.5, 3., 6., 12.}) {  // h/d
    double mean = 0, worst = 0;
    for (const Vec3& p : places) {
      const Vec3 x = Vec3{2, 2, 2} + p;
      const double wrong = misplaced(cells.deposited(x, 0.5 / ratio), exact(x, 0.5 / ratio));
      mean += wrong / static_cast<double>(places.size());
      worst = std::max(worst, wrong);
    }
    test::save_result("void_fraction_overlap",
                      {{"cell_over_d", ratio}, {"mean", mean}, {"worst", worst}});
    if (last > 0) test::expect_order("share in wrong cells", last, mean, 1, 0.25);
    last = mean;
  }
}

/// A grain near a border is as well placed as one at the same distance from faces inside.
TEST(VoidFractionOverlap, BordersAndCornersChangeNothing) {
  const Cells cells;
  const double r = 0.5 / 1.5;
  double inside = 0, periodic = 0, wall = 0, corner = 0;
  for (const Vec3& p : random_places(500, 3)) {
    const Vec3 offset = 0.9 * r * (2 * p - Vec3{1, 1, 1});
    const Vec3 node = Vec3{3, 3, 3} + offset;
    const auto shares = cells.deposited(node, r);
    inside += misplaced(shares, exact(node, r));

    // Across the periodic faces and edges: the same shares, moved.
    const Vec3 seam = Vec3{0, 3, 6} + offset;
    Shares moved;
    for (const auto& [c, share] : shares) moved[fold({c[0] - 3, c[1], c[2] + 3})] += share;
    EXPECT_LT(misplaced(cells.deposited(seam, r), moved), 1e-12);
    periodic += misplaced(cells.deposited(seam, r), exact(seam, r));

    // Floor and lid: the lowest and the highest row have also what lies behind them.
    for (const int side : {0, kCells}) {
      const Vec3 at_wall = Vec3{3, double(side), 3} + offset;
      Shares mirrored;
      for (const auto& [c, share] : shares) mirrored[fold({c[0], c[1] + side - 3, c[2]})] += share;
      EXPECT_LT(misplaced(by_row(cells.deposited(at_wall, r)), by_row(mirrored)), 1e-12);
      wall += misplaced(cells.deposited(at_wall, r), exact(at_wall, r)) / 2;
    }
    const Vec3 at_corner = Vec3{0, 0, 0} + offset;
    corner += misplaced(cells.deposited(at_corner, r), exact(at_corner, r));
  }
  test::expect_relative("misplaced share around a node, across a period", periodic, inside, 1e-6);
  EXPECT_LT(wall, inside) << "two cells in one: what is misplaced between them does not count";
  EXPECT_LT(corner, inside);
}

/// q - L^2 lap(q) = point: the integral stays, the second moment is 2 L^2 in each direction.
TEST(SmoothingKernel, IntegralAndVariance) {
  const double h = 2e-4, length = 6e-4, d = 2e-4;
  const int n = 60;  // 20 L: what the kernel has beyond that is e^-10
  Config config = test::water_box({n, n, n}, {n * h, n * h, n * h});
  config.coupling.smoothing_length = length;
  config.coupling.scheme = CouplingScheme::centred;
  config.coupling.centred.void_fraction = VoidFraction::centre;
  config.grains->frozen = true;
  InitialGrains grain;
  const double at = (n / 2 + 0.5) * h;
  test::add_grain(grain, d, {at, at, at});
  const test::CoupledRun run(config, grain);
  const auto alpha = test::to_host(run.state.fluid->alpha_f);
  double sum = 0;
  Vec3 second;
  test::for_owned_cells(run.state.fluid->grid, [&](int i, int j, int k) {
    const double solid = (1 - alpha(i, j, k)) * h * h * h;
    const auto square = [&](int q) { return std::pow((q + 0.5) * h - at, 2); };
    sum += solid;
    second += solid * Vec3{square(i), square(j), square(k)};
  });
  test::expect_relative("integral of the smoothed volume", sum, test::volume_of(d), 1e-12);
  for (const double v : {second.x, second.y, second.z}) {
    test::expect_relative("variance of the smoothing", v / sum, 2 * length * length, 0.02);
  }
}

}  // namespace
}  // namespace barchan
