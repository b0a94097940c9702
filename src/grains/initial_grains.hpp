// Grains as a file or a pour gives them.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Grains in the order of the file; all vectors have the same length.
struct InitialGrains {
  std::vector<std::int64_t> id;
  std::vector<double> diameter;  // [m]
  std::vector<Vec3> x;           // centre [m]
  std::vector<Vec3> u;           // velocity [m/s]
  std::vector<Vec3> omega;       // spin [rad/s]

  std::size_t size() const { return id.size(); }
};

}  // namespace barchan
