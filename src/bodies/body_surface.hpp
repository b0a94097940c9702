// Surfaces of bodies as lattices of points, for programs that draw and measure.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "src/bodies/bodies_case.hpp"
#include "src/io/hdf5_file.hpp"

namespace barchan {

inline constexpr const char* kBodiesFile = "bodies.h5";

/// A body above the floor as a lattice of places seen from above, found with its distance alone.
/// Lines of places go from its middle to its outline, all around; for a body that is endless along
/// x and along z, across the domain, all along x. Lengths in m.
struct BodySurface {
  std::size_t lines = 0, points = 0;      // along each line
  std::vector<double> x, z, bottom, top;  // lines x points; no body there: bottom and top are equal
  std::vector<double> copies;             // x, z by which each part is moved: of a fence the posts
};
BodySurface body_surface(BodyConfig body, const std::array<double, 3>& domain);

/// Writes a whole file of the surfaces of all bodies, or leaves the old one. Throws Hdf5Error.
void write_body_surfaces(const std::filesystem::path& path, const std::vector<BodyConfig>& bodies,
                         const std::array<double, 3>& domain, const Provenance& provenance);

}  // namespace barchan
