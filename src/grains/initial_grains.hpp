// Initial grains: from a file or poured.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "kernels/math/vec3.hpp"

namespace barchan {

struct PourConfig;
struct SizeClass;

/// Grains in the order of the file; all vectors have the same length.
struct InitialGrains {
  std::vector<std::int64_t> id;
  std::vector<double> diameter;  // [m]
  std::vector<Vec3> x;           // centre [m]
  std::vector<Vec3> u;           // velocity [m/s]
  std::vector<Vec3> omega;       // angular velocity [rad/s]

  std::size_t size() const { return id.size(); }
  void add(std::int64_t new_id, double d, const Vec3& centre, const Vec3& velocity = {},
           const Vec3& spin = {}) {
    id.push_back(new_id);
    diameter.push_back(d);
    x.push_back(centre);
    u.push_back(velocity);
    omega.push_back(spin);
  }
};

/// By the ending: .csv, or .h5, which is a grains.h5 (its last frame) or a restart file (arrays
/// grains/id and grains/kin). Throws std::runtime_error with a sentence for the user.
InitialGrains read_grains(const std::filesystem::path& file);

/// Columns by header in any order: id,diameter,x,y,z and optionally vx,vy,vz,wx,wy,wz (SI units).
/// Empty lines and lines that start with # are skipped. Throws std::runtime_error
/// "heap.csv:12: ..." for a missing or unknown column, a bad or not finite number, a wrong number
/// of columns, a diameter that is not positive, an id used twice. Overlap is not looked at.
InitialGrains parse_grains_csv(std::string_view text, std::string_view file_name);

/// A heap of hexagonal close packed sites 1 % wider than the largest grain, jittered by 0.2 %,
/// holding the grains of `sizes` in random order: no overlap, no order that survives the collapse.
/// Sites fill a cone of foot radius pour.radius [m] from its axis outward and upward, or a bed from
/// the floor up, so the number of grains decides the height. Throws std::runtime_error if the heap
/// leaves the domain.
InitialGrains pour_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                          const std::array<double, 3>& domain);

/// The same heap moved together to about what it settles to, for measurements of time: a grain
/// touches about four others, as in a heap at rest. Overlaps are up to half a diameter.
InitialGrains packed_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                            const std::array<double, 3>& domain);

}  // namespace barchan
