#include "src/grains/clump_shape.hpp"

#include <Eigen/Dense>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "kernels/grains/sphere.hpp"
#include "src/grains/disc_cells.hpp"
#include "src/grains/union_of_spheres.hpp"

namespace barchan {

namespace {

constexpr Real kGap = 1e-5;         // spheres that touch may be as far apart, over their radii
constexpr Real kLeastPart = 1e-6;   // of a sphere that is its own, over its volume
constexpr Real kSameMoment = 1e-9;  // moments that differ by less, over the largest, are equal

Eigen::Vector3d eigen(const Vec3& a) { return {a.x, a.y, a.z}; }
Vec3 vec3(const Eigen::Vector3d& a) { return {a(0), a(1), a(2)}; }

bool touch(const ClumpSphere& a, const ClumpSphere& b) {
  return norm(b.centre - a.centre) <= (1 + kGap) * (a.radius + b.radius);
}

/// Number of the first sphere that no chain of touching spheres joins to sphere 0; 0 if none.
std::size_t first_apart(const std::vector<ClumpSphere>& spheres) {
  std::vector<bool> reached(spheres.size(), false);
  std::vector<std::size_t> next{0};
  reached[0] = true;
  while (!next.empty()) {
    const std::size_t i = next.back();
    next.pop_back();
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      if (reached[j] || !touch(spheres[i], spheres[j])) continue;
      reached[j] = true;
      next.push_back(j);
    }
  }
  for (std::size_t j = 0; j < spheres.size(); ++j) {
    if (!reached[j]) return j;
  }
  return 0;
}

/// Axis with a sign that does not hang on round-off: its first component that is not 0 is positive.
Eigen::Vector3d with_sign(const Eigen::Vector3d& axis) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis(k)) > 1e-6) return axis(k) < 0 ? Eigen::Vector3d(-axis) : axis;
  }
  return axis;
}

/// Unit vector across an axis, as near as can be to the first of the given axes that is most
/// across.
Eigen::Vector3d across(const Eigen::Vector3d& axis) {
  const Real least = axis.cwiseAbs().minCoeff() + 1e-6;
  Eigen::Index k = 0;
  while (std::abs(axis(k)) > least) ++k;
  const Eigen::Vector3d given = Eigen::Vector3d::Unit(k);
  return (given - axis.dot(given) * axis).normalized();
}

/// Right-handed principal axes as columns, the smallest moment first.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  const Eigen::Vector3d moments = solver.eigenvalues();
  const Real same = kSameMoment * moments(2);
  if (moments(2) - moments(0) < same) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes;
  if (moments(1) - moments(0) < same) {
    axes.col(2) = with_sign(solver.eigenvectors().col(2));
    axes.col(0) = across(axes.col(2));
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }
  axes.col(0) = with_sign(solver.eigenvectors().col(0));
  axes.col(1) = moments(2) - moments(1) < same ? across(axes.col(0))
                                               : with_sign(solver.eigenvectors().col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// What is wrong with spheres that make no clump; empty if nothing.
std::string problem_of(const std::vector<ClumpSphere>& spheres) {
  if (spheres.empty()) return "a clump needs at least one sphere";
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& [c, radius] = spheres[i];
    if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
      return fmt::format("the centre of sphere {} of a clump is no number", i + 1);
    if (!(radius > 0) || !std::isfinite(radius))
      return fmt::format("the radius of sphere {} of a clump is {}; it must be positive", i + 1,
                         radius);
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      if (i == j) continue;
      const Real room = spheres[j].radius - spheres[i].radius;
      if (norm(spheres[i].centre - spheres[j].centre) <= room && (room > 0 || i > j))
        return fmt::format("sphere {} of a clump is wholly inside sphere {}; leave it out", i + 1,
                           j + 1);
    }
  }
  if (const std::size_t j = first_apart(spheres); j > 0)
    return fmt::format("sphere {} of a clump touches none that is joined to sphere 1", j + 1);
  return {};
}

/// The same of one that has nothing of its own.
std::string problem_of_hidden(const std::vector<ClumpSphere>& spheres,
                              const UnionMoments& moments) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (moments.volumes[i] < kLeastPart * sphere_volume(spheres[i].radius))
      return fmt::format("sphere {} of a clump is wholly inside the others; leave it out", i + 1);
  }
  return {};
}

ClumpShape shape_of(const std::vector<ClumpSphere>& spheres, const UnionMoments& moments) {
  const Eigen::Vector3d centre = moments.first / moments.volume;
  const Eigen::Matrix3d spread = moments.second / moments.volume - centre * centre.transpose();
  const Eigen::Matrix3d inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  const Eigen::Matrix3d axes = principal_axes(inertia);

  ClumpShape shape;
  shape.centre = vec3(moments.origin + centre);
  shape.diameter = std::cbrt(6 * moments.volume / std::numbers::pi_v<Real>);
  const Eigen::Quaterniond q(axes);
  shape.principal_axes = {q.w(), q.x(), q.y(), q.z()};
  const Real scale = 1 / shape.diameter;
  shape.inertia = vec3(scale * scale * (axes.transpose() * inertia * axes).diagonal());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Eigen::Vector3d at =
        axes.transpose() * (eigen(spheres[i].centre) - moments.origin - centre);
    shape.spheres.push_back({scale * vec3(at), scale * spheres[i].radius});
    shape.bounding_radius = std::max(
        shape.bounding_radius, norm(shape.spheres.back().centre) + shape.spheres.back().radius);
    shape.shares.push_back(moments.volumes[i] / moments.volume);
    shape.surface += scale * scale * moments.surfaces[i];
  }
  shape.projected_areas = {projected_area(shape.spheres, {1, 0, 0}),
                           projected_area(shape.spheres, {0, 1, 0}),
                           projected_area(shape.spheres, {0, 0, 1})};
  return shape;
}

}  // namespace

ShapeOrProblem make_clump(const std::vector<ClumpSphere>& spheres, int nodes) {
  if (const std::string problem = problem_of(spheres); !problem.empty()) return {{}, problem};
  const UnionMoments moments = moments_of_union(spheres, nodes);
  if (const std::string hidden = problem_of_hidden(spheres, moments); !hidden.empty())
    return {{}, hidden};
  return {shape_of(spheres, moments), {}};
}

ClumpShape clump_shape(const std::vector<ClumpSphere>& spheres, int nodes) {
  const ShapeOrProblem made = make_clump(spheres, nodes);
  if (!made.problem.empty()) throw std::runtime_error(made.problem);
  return made.shape;
}

Real ClumpShape::sphericity() const {
  return std::min(std::numbers::pi_v<Real> / surface, Real(1));
}

Real projected_area(const std::vector<ClumpSphere>& spheres, const Vec3& direction) {
  const Eigen::Vector3d along = eigen(direction).normalized();
  const Eigen::Vector3d e1 = across(along), e2 = along.cross(e1);
  std::vector<Disc> discs;
  for (const auto& [c, radius] : spheres)
    discs.push_back({e1.dot(eigen(c)), e2.dot(eigen(c)), radius});
  Real area = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) area += disc_cell(discs, i).moments.area;
  return area;
}

}  // namespace barchan
