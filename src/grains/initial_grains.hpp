// Grains that a run starts from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/grains/clump.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Grains in the order of the file; all vectors have the same length, or are empty.
struct InitialGrains {
  std::vector<std::int64_t> id;
  std::vector<double> diameter;  // [m]
  std::vector<Vec3> x;           // centre [m]
  std::vector<Vec3> u;           // velocity [m/s]
  std::vector<Vec3> omega;       // angular velocity [rad/s]
  // Index of each grain's kind and heap, if there are several; else empty.
  std::vector<std::uint8_t> kind = {}, heap = {};
  // Orientation of each grain, from a file that has it; motion of the clump of each sphere, where
  // there are clumps (as_members); else empty.
  std::vector<Quaternion> q = {};
  std::vector<ClumpMotion> clump = {};
  std::vector<std::string> kind_names = {};  // from a file that has kinds
  std::vector<ShapeConfig> shapes = {};      // of each kind, from a file that says them
  std::vector<std::string> heap_names = {};  // may be empty: a table has none
  std::int64_t last_id = 0;  // largest id of these grains and of those that have left

  std::size_t size() const { return id.size(); }
  int kind_of(std::size_t g) const { return kind.empty() ? 0 : kind[g]; }
  void add(std::int64_t new_id, double d, const Vec3& centre, const Vec3& velocity = {},
           const Vec3& spin = {}) {
    id.push_back(new_id);
    diameter.push_back(d);
    x.push_back(centre);
    u.push_back(velocity);
    omega.push_back(spin);
  }
  /// Removes those that are not marked.
  void keep(const std::vector<bool>& marked) {
    const auto keep_of = [&marked](auto& values) {  // which may be empty
      std::size_t n = 0;
      for (std::size_t g = 0; g < values.size(); ++g)
        if (marked[g]) values[n++] = values[g];
      values.resize(n);
    };
    keep_of(id), keep_of(diameter), keep_of(x), keep_of(u), keep_of(omega);
    keep_of(kind), keep_of(heap), keep_of(q), keep_of(clump);
  }
};

}  // namespace barchan
