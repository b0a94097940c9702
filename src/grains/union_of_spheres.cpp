#include "src/grains/union_of_spheres.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "src/grains/disc_cells.hpp"

namespace barchan {

namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;

struct Ball {
  Eigen::Vector3d c;
  Real r;
};

/// Rotation into the frame that is sliced along its z.
Eigen::Matrix3d slicing_frame() {
  return Eigen::Quaterniond(0.73, 0.31, -0.47, 0.19).normalized().toRotationMatrix();
}

/// Point of one sphere relative to its centre that has equal power to others: planes n . p = b.
struct EqualPower {
  Eigen::Vector3d n;
  Real b;
};
EqualPower equal_power(const Ball& of, const Ball& other) {
  const Eigen::Vector3d n = other.c - of.c;
  return {n, (n.squaredNorm() + (of.r - other.r) * (of.r + other.r)) / 2};
}

bool overlap(const Ball& a, const Ball& b) { return (b.c - a.c).norm() < a.r + b.r; }

/// Heights at which a slice changes its topology: ends of spheres, ends of the circles in which two
/// meet, points in which three meet, corners of four cells.
class Heights {
 public:
  explicit Heights(const std::vector<Ball>& balls) : balls_(balls) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
      add(balls[i].c.z(), balls[i].r);
      std::vector<std::size_t> near;  // those after it that overlap it
      for (std::size_t j = i + 1; j < balls.size(); ++j) {
        if (overlap(balls[i], balls[j])) near.push_back(j);
      }
      for (auto j = near.begin(); j != near.end(); ++j) {
        add_circle(balls[i], equal_power(balls[i], balls[*j]));
        for (auto k = j + 1; k != near.end(); ++k) {
          if (overlap(balls[*j], balls[*k])) add_triple(i, *j, *k, {k + 1, near.end()});
        }
      }
    }
    std::ranges::sort(z_);
  }
  const std::vector<Real>& sorted() const { return z_; }

 private:
  void add(Real middle, Real half) { z_.push_back(middle - half), z_.push_back(middle + half); }

  void add_circle(const Ball& ball, const EqualPower& plane) {
    const Real d = plane.n.norm(), h = plane.b / d, slope = plane.n.z() / d;
    const Real square = (ball.r - h) * (ball.r + h) * (1 - slope) * (1 + slope);
    if (square > 0) add(ball.c.z() + h * slope, std::sqrt(square));
  }
  void add_triple(std::size_t i, std::size_t j, std::size_t k,
                  const std::vector<std::size_t>& after) {
    const Ball& ball = balls_[i];
    const EqualPower p = equal_power(ball, balls_[j]), q = equal_power(ball, balls_[k]);
    const Eigen::Vector3d along = p.n.cross(q.n);
    const Real square = along.squaredNorm();
    if (square <= 1e-20 * p.n.squaredNorm() * q.n.squaredNorm()) return;
    const Eigen::Vector3d foot = (p.b * q.n.cross(along) + q.b * along.cross(p.n)) / square;
    const Real room = ball.r * ball.r - foot.squaredNorm();
    if (room <= 0) return;
    add(ball.c.z() + foot.z(), std::sqrt(room / square) * std::abs(along.z()));
    for (const std::size_t l : after) {
      if (!overlap(balls_[j], balls_[l]) || !overlap(balls_[k], balls_[l])) continue;
      const EqualPower plane = equal_power(ball, balls_[l]);
      const Real rise = plane.n.dot(along);
      const Real far = (plane.b - plane.n.dot(foot)) / rise;
      if (far * far * square <= room) z_.push_back(ball.c.z() + foot.z() + far * along.z());
    }
  }

  const std::vector<Ball>& balls_;
  std::vector<Real> z_;
};

/// Ends of intervals of integration: the heights, and points between them, denser and denser
/// towards a height behind which another one is near, as that slows convergence: an interval is at
/// most about twice as long as it is far from heights outside.
std::vector<Real> graded(const std::vector<Real>& heights) {
  const Real same = 1e-13 * (heights.back() - heights.front());
  std::vector<Real> z{heights.front()};
  for (const Real height : heights) {
    if (height - z.back() > same) z.push_back(height);
  }
  std::vector<Real> ends;
  for (std::size_t n = 0; n + 1 < z.size(); ++n) {
    const Real a = z[n], b = z[n + 1], half = (b - a) / 2;
    ends.push_back(a);
    const Real before = n > 0 ? a - z[n - 1] : half, after = n + 2 < z.size() ? z[n + 2] - b : half;
    for (Real x = 2 * before; x < half; x = 2 * (x + before)) ends.push_back(a + x);
    const std::size_t middle = ends.size();
    for (Real x = 2 * after; x < half; x = 2 * (x + after)) ends.push_back(b - x);
    std::reverse(ends.begin() + static_cast<std::ptrdiff_t>(middle), ends.end());
  }
  ends.push_back(z.back());
  return ends;
}

struct Node {
  Real t, weight;
};
/// Nodes and weights of Gauss-Legendre quadrature on [0, 1], by Newton's method for the roots.
std::vector<Node> gauss_legendre(int n) {
  std::vector<Node> nodes;
  for (int i = 0; i < n; ++i) {
    Real x = std::cos(kPi * (i + Real(0.75)) / (n + Real(0.5))), slope = 1;
    for (int step = 0; step < 8; ++step) {
      Real p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const Real next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p, p = next;
      }
      slope = n * (before - x * p) / (1 - x * x);
      x -= p / slope;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

/// Adds a slice of a width at a height. On a sphere the area between two heights is r dphi dz.
void add_slice(UnionMoments& sum, const std::vector<Ball>& balls, Real z, Real width) {
  std::vector<Disc> discs;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Real height = z - balls[i].c.z();
    const Real square = (balls[i].r - height) * (balls[i].r + height);
    if (square <= 0) continue;
    discs.push_back({balls[i].c.x(), balls[i].c.y(), std::sqrt(square)});
    numbers.push_back(i);
  }
  for (std::size_t n = 0; n < discs.size(); ++n) {
    const DiscCell cell = disc_cell(discs, n);
    const PlaneMoments& m = cell.moments;
    sum.volumes[numbers[n]] += width * m.area;
    sum.surfaces[numbers[n]] += width * balls[numbers[n]].r * cell.exposed;
    sum.first += width * Eigen::Vector3d(m.x, m.y, z * m.area);
    Eigen::Matrix3d second;
    second << m.xx, m.xy, z * m.x, m.xy, m.yy, z * m.y, z * m.x, z * m.y, z * z * m.area;
    sum.second += width * second;
  }
}

}  // namespace

UnionMoments moments_of_union(const std::vector<ClumpSphere>& spheres, int nodes) {
  const Eigen::Matrix3d frame = slicing_frame();
  UnionMoments sum;
  for (const auto& [c, radius] : spheres)
    sum.origin += Eigen::Vector3d(c.x, c.y, c.z) / static_cast<Real>(spheres.size());
  std::vector<Ball> balls;
  for (const auto& [c, radius] : spheres)
    balls.push_back({frame * (Eigen::Vector3d(c.x, c.y, c.z) - sum.origin), radius});
  sum.volumes.assign(balls.size(), 0);
  sum.surfaces.assign(balls.size(), 0);
  const std::vector<Real> z = graded(Heights(balls).sorted());
  const std::vector<Node> rule = gauss_legendre(nodes);
  for (std::size_t n = 0; n + 1 < z.size(); ++n) {
    const Real length = z[n + 1] - z[n];
    for (const auto& [t, weight] : rule) {
      add_slice(sum, balls, z[n] + length * t * t * (3 - 2 * t), length * 6 * t * (1 - t) * weight);
    }
  }
  for (const Real volume : sum.volumes) sum.volume += volume;
  sum.first = frame.transpose() * sum.first;
  sum.second = frame.transpose() * sum.second * frame;
  return sum;
}

}  // namespace barchan
