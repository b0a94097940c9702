// Exact volume that a sphere shares with an axis-parallel box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace barchan::test {

/// Area of the disc of radius r around the origin with x < a and y < b.
inline double quarter_disc(double a, double b, double r) {
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
inline double sphere_box_overlap(const std::array<double, 3>& centre, double radius,
                                 const Box& box) {
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

}  // namespace barchan::test
