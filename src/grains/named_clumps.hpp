// Clumps that a case can name.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "src/grains/clump_shape.hpp"

namespace barchan {

inline constexpr std::array<std::string_view, 4> kNamedClumps{"dimer", "tetrahedron", "cube",
                                                              "sand"};

/// Spheres of a clump by its name, in an arbitrary unit; none if there is no such name.
std::vector<ClumpSphere> named_clump(std::string_view name);

}  // namespace barchan
