// Grains from a CSV table.
#pragma once

#include <string_view>

#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Reads a table. Columns by header in any order: id,diameter,x,y,z and optionally
/// vx,vy,vz,wx,wy,wz (SI units) kind (a name) and heap (from 0 to 254, or -1: of none). The titles
/// of the Python package (d, u, omega_x) and radius are read, too, its results (dune, forces)
/// passed over. Empty lines and lines that start with # are skipped, except a header there where no
/// other is. Throws std::runtime_error "heap.csv:12: ..." for a missing or unknown column, a bad or
/// not finite number, a wrong number of columns, a diameter that is not positive, an id used twice.
/// Overlaps are not checked.
InitialGrains parse_grains_csv(std::string_view text, std::string_view file_name);

}  // namespace barchan
