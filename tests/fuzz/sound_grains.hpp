// What a run relies on in grains that a reader has accepted.
#pragma once

#include <cmath>
#include <unordered_set>

#include "src/grains/initial_grains.hpp"
#include "tests/fuzz/fuzzed.hpp"

namespace barchan::fuzz {

inline void demand_sound(const InitialGrains& grains) {
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const std::size_t n = grains.size();
  demand(grains.diameter.size() == n && grains.x.size() == n && grains.u.size() == n &&
             grains.omega.size() == n && grains.id.size() == n,
         "every grain has all its numbers");
  std::unordered_set<std::int64_t> ids;
  for (std::size_t g = 0; g < n; ++g) {
    demand(grains.diameter[g] > 0 && std::isfinite(grains.diameter[g]), "diameters are positive");
    demand(finite(grains.x[g]) && finite(grains.u[g]) && finite(grains.omega[g]),
           "positions and velocities are finite");
    demand(ids.insert(grains.id[g]).second, "ids are unique");
  }
}

}  // namespace barchan::fuzz
