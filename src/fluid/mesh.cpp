#include "src/fluid/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace barchan {
namespace {

/// 1 + q + ... + q^(n-1), in a form that keeps its digits when q is close to 1.
double geometric_sum(double q, int n) {
  const double growth = q - 1;
  return growth == 0 ? n : std::expm1(n * std::log1p(growth)) / growth;
}

/// The rows that grow, with the last of the equal ones, which they grow from.
RowSpacing growing_part(const RowSpacing& all) {
  const int below = uniform_rows(all) - 1;
  return {.height = all.height - below * all.first, .rows = all.rows - below, .first = all.first};
}

bool all_equal(const RowSpacing& s) {
  const double mean = s.height / s.rows;
  return s.first == 0 || std::abs(s.first - mean) <= 1e-9 * mean;
}

}  // namespace

RowSpacing row_spacing(const FluidConfig& fluid, double height) {
  return {.height = height,
          .rows = fluid.cells[1],
          .first = fluid.first_cell_height,
          .uniform_to = fluid.uniform_height};
}

int uniform_rows(const RowSpacing& spacing) {
  if (!(spacing.first > 0)) return 1;
  const double rows = std::ceil(spacing.uniform_to / spacing.first - 1e-9);
  return static_cast<int>(std::clamp(rows, 1.0, std::max(1.0, 1.0 * spacing.rows)));
}

bool rows_fit(const RowSpacing& s) {
  if (!(s.height > 0) || s.rows < 1 || !(s.first >= 0)) return false;
  if (all_equal(s)) return true;
  const RowSpacing part = growing_part(s);
  return part.rows > 1 && part.first < part.height / part.rows;
}

double stretching_ratio(const RowSpacing& s) {
  if (!rows_fit(s)) {
    throw std::invalid_argument(fmt::format("no mesh of {} rows over {} m from a first row of {} m",
                                            s.rows, s.height, s.first));
  }
  if (all_equal(s)) return 1;
  // The sum grows with q and its last term alone exceeds height / first at the upper end.
  const RowSpacing part = growing_part(s);
  const double target = part.height / part.first;
  double low = 1;
  double high = std::pow(target, 1.0 / (part.rows - 1));
  for (int n = 0; n < 200 && high - low > 1e-15 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (geometric_sum(middle, part.rows) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> row_faces(const RowSpacing& s) {
  const double q = stretching_ratio(s);
  const RowSpacing part = all_equal(s) ? s : growing_part(s);
  const double whole = geometric_sum(q, part.rows);  // scaled by it the last face is exact
  std::vector<double> faces;
  for (int j = 0; j < s.rows - part.rows; ++j) faces.push_back(j * s.first);
  const double bottom = s.height - part.height;
  for (int j = 0; j < part.rows; ++j)
    faces.push_back(bottom + part.height * (geometric_sum(q, j) / whole));
  faces.push_back(s.height);
  return faces;
}

}  // namespace barchan
