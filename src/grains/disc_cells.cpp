#include "src/grains/disc_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace barchan {

namespace {

constexpr Real kTurn = 2 * std::numbers::pi_v<Real>;

/// Half plane u . p <= h that the power of another disc leaves; p from the centre of the disc.
struct Cut {
  Real u_x, u_y, h;
};

/// The half planes that cut a disc; nothing if one leaves none of it.
std::optional<std::vector<Cut>> cuts_of(std::span<const Disc> discs, std::size_t i) {
  const Disc& disc = discs[i];
  std::vector<Cut> cuts;
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    const Disc& other = discs[j];
    const Real x = other.x - disc.x, y = other.y - disc.y, d = std::hypot(x, y);
    const Real difference = (disc.radius - other.radius) * (disc.radius + other.radius);
    if (d == 0) {  // of equal discs the first has the cell
      if (difference < 0 || (difference == 0 && j < i)) return {};
      continue;
    }
    const Real h = (d + difference / d) / 2;
    if (h <= -disc.radius) return {};
    if (h < disc.radius) cuts.push_back({x / d, y / d, h});
  }
  return cuts;
}

/// Half of the chord on the line of a half plane.
Real half_chord(Real radius, const Cut& cut) {
  return std::sqrt((radius - cut.h) * (radius + cut.h));
}

/// Adds a sector about the centre, from angle a to b.
void add_sector(PlaneMoments& sum, Real radius, Real a, Real b) {
  const Real square = radius * radius, angle = b - a;
  const Real sin_a = std::sin(a), sin_b = std::sin(b), cos_a = std::cos(a), cos_b = std::cos(b);
  const Real cubed = square * radius / 3, fourth = square * square / 8;
  const Real twice = sin_b * cos_b - sin_a * cos_a;  // of sin 2 phi, half its difference
  sum.area += square * angle / 2;
  sum.x += cubed * (sin_b - sin_a), sum.y += cubed * (cos_a - cos_b);
  sum.xx += fourth * (angle + twice), sum.yy += fourth * (angle - twice);
  sum.xy += fourth * (sin_b - sin_a) * (sin_b + sin_a);
}

/// Adds the triangle of the centre, p and q; negative if they turn clockwise.
void add_triangle(PlaneMoments& sum, Vec2 p, Vec2 q) {
  const Real area = (p.x * q.z - p.z * q.x) / 2;
  sum.area += area;
  sum.x += area * (p.x + q.x) / 3, sum.y += area * (p.z + q.z) / 3;
  sum.xx += area * (p.x * p.x + q.x * q.x + p.x * q.x) / 6;
  sum.yy += area * (p.z * p.z + q.z * q.z + p.z * q.z) / 6;
  sum.xy += area * (2 * (p.x * p.z + q.x * q.z) + p.x * q.z + q.x * p.z) / 12;
}

/// Adds what lies between the centre and the arcs that no half plane cuts off; returns their angle.
Real add_arcs(PlaneMoments& sum, Real radius, const std::vector<Cut>& cuts) {
  std::vector<std::pair<Real, Real>> hidden;
  for (const Cut& cut : cuts) {
    const Real half = std::atan2(half_chord(radius, cut), cut.h);
    Real begin = std::atan2(cut.u_y, cut.u_x) - half;
    if (begin < 0) begin += kTurn;
    const Real end = begin + 2 * half;
    hidden.emplace_back(begin, std::min(end, kTurn));
    if (end > kTurn) hidden.emplace_back(0, end - kTurn);
  }
  hidden.emplace_back(kTurn, kTurn);
  std::ranges::sort(hidden);
  Real from = 0, exposed = 0;
  for (const auto& [begin, end] : hidden) {
    if (begin > from) add_sector(sum, radius, from, begin), exposed += begin - from;
    from = std::max(from, end);
  }
  return exposed;
}

/// Adds what lies between the centre and the chord on the line of one half plane.
void add_chord(PlaneMoments& sum, Real radius, const std::vector<Cut>& cuts, std::size_t n) {
  const Cut& line = cuts[n];
  const Real half = half_chord(radius, line);
  Real from = -half, to = half;
  for (std::size_t m = 0; m < cuts.size(); ++m) {
    if (m == n) continue;
    const Cut& cut = cuts[m];
    const Real along = cut.u_y * line.u_x - cut.u_x * line.u_y;
    const Real room = cut.h - line.h * (cut.u_x * line.u_x + cut.u_y * line.u_y);
    if (along > 0) {
      to = std::min(to, room / along);
    } else if (along < 0) {
      from = std::max(from, room / along);
    } else if (room < 0 || (room == 0 && m < n)) {  // of equal lines the first counts
      return;
    }
  }
  if (from >= to) return;
  const auto point = [&](Real t) {
    return Vec2{line.h * line.u_x - t * line.u_y, line.h * line.u_y + t * line.u_x};
  };
  add_triangle(sum, point(from), point(to));
}

/// Moments about the origin of the plane from those about (x, y).
PlaneMoments about_origin(const PlaneMoments& m, Real x, Real y) {
  return {.area = m.area,
          .x = m.x + x * m.area,
          .y = m.y + y * m.area,
          .xx = m.xx + x * (2 * m.x + x * m.area),
          .xy = m.xy + x * m.y + y * (m.x + x * m.area),
          .yy = m.yy + y * (2 * m.y + y * m.area)};
}

}  // namespace

DiscCell disc_cell(std::span<const Disc> discs, std::size_t i) {
  const auto cuts = cuts_of(discs, i);
  if (!cuts) return {};
  const Disc& disc = discs[i];
  DiscCell cell;
  cell.exposed = add_arcs(cell.moments, disc.radius, *cuts);
  for (std::size_t n = 0; n < cuts->size(); ++n) add_chord(cell.moments, disc.radius, *cuts, n);
  cell.moments = about_origin(cell.moments, disc.x, disc.y);
  return cell;
}

}  // namespace barchan
