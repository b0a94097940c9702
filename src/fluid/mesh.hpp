// The wall-normal spacing of the mesh: equal rows at the floor, growing ones above.
#pragma once

#include <vector>

#include "src/fluid/fluid_case.hpp"

namespace barchan {

/// Rows of cells between floor and lid, from the floor up: the lowest ones equal, those above
/// growing by a constant ratio. Lengths in m.
struct RowSpacing {
  double height = 0;  // of the domain
  int rows = 1;
  double first = 0;       // height of the lowest row; 0: all rows are equal
  double uniform_to = 0;  // rows that begin below this height are as high as the first
  bool operator==(const RowSpacing&) const = default;
};

/// Spacing of the rows of [fluid] in a domain of this height [m].
RowSpacing row_spacing(const FluidConfig& fluid, double height);

/// Rows that are as high as the first, at least 1.
int uniform_rows(const RowSpacing& spacing);

/// True if rows of this spacing that do not shrink can fill the height, or if `first` is 0 or the
/// mean height (to 1e-9): all equal.
bool rows_fit(const RowSpacing& spacing);

/// Constant ratio q >= 1 of neighbouring rows above the n equal ones:
/// first (n - 1 + (q^m - 1)/(q - 1)) = height, m = rows - n + 1. All equal: 1.
/// Mesh 1 of the paper: height 0.025, 30 rows, first 2.625e-4 gives 1.0705.
/// Throws std::invalid_argument unless rows_fit.
double stretching_ratio(const RowSpacing& spacing);

/// The rows + 1 faces [m]: the first is 0 and the last is `height` exactly. Throws as
/// stretching_ratio.
std::vector<double> row_faces(const RowSpacing& spacing);

}  // namespace barchan
