// Volume, moments and surface of a union of spheres.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "src/grains/clump_shape.hpp"

namespace barchan {

/// Integrals of 1, x and x x^T over the union, x from a point in its midst, so that little is lost
/// by differences of large numbers. Volume and surface by spheres; the volume of a sphere is that
/// of its cell in the power diagram.
struct UnionMoments {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Real volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  std::vector<Real> volumes, surfaces;
};

/// Integrates exact slices. Between two heights a and b at which a slice changes its topology
/// everything is analytic in the root of the distance to either, so with z = a + (b - a) t^2 (3 -
/// 2t) Gauss-Legendre quadrature in t converges exponentially; 8 nodes are exact for a sphere
/// alone. The direction of slicing is a fixed one that is no symmetry of common clumps.
UnionMoments moments_of_union(const std::vector<ClumpSphere>& spheres, int nodes);

}  // namespace barchan
