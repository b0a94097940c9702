#include "src/config/mesh.hpp"

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

bool uniform(double mean, double first) {
  return first == 0 || std::abs(first - mean) <= 1e-9 * mean;
}

}  // namespace

bool rows_fit(double ly, int ny, double first) {
  if (!(ly > 0) || ny < 1 || !(first >= 0)) return false;
  return uniform(ly / ny, first) || (first < ly / ny && ny > 1);
}

double stretching_ratio(double ly, int ny, double first) {
  if (!rows_fit(ly, ny, first)) {
    throw std::invalid_argument(
        fmt::format("no mesh of {} rows over {} m from a first row of {} m", ny, ly, first));
  }
  if (uniform(ly / ny, first)) return 1;
  // The sum grows with q and its last term alone exceeds ly / first at the upper end.
  const double target = ly / first;
  double low = 1;
  double high = std::pow(target, 1.0 / (ny - 1));
  for (int n = 0; n < 200 && high - low > 1e-15 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (geometric_sum(middle, ny) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> stretched_faces(double ly, int ny, double first) {
  const double q = stretching_ratio(ly, ny, first);
  std::vector<double> faces(ny + 1);
  const double whole = geometric_sum(q, ny);  // scaled by it the last face is ly to the bit
  for (int j = 0; j <= ny; ++j) faces[j] = ly * (geometric_sum(q, j) / whole);
  return faces;
}

}  // namespace barchan
