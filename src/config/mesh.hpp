// The wall-normal spacing of the mesh: rows that grow by a constant ratio away from the floor.
#pragma once

#include <vector>

namespace barchan {

/// True if `ny` rows that start with `first` and do not shrink can fill the height `ly`, or if
/// `first` is 0 or ly/ny (to 1e-9): uniform.
bool rows_fit(double ly, int ny, double first);

/// Constant ratio q >= 1 of neighbouring row heights for which `ny` rows fill the height `ly`:
/// first (q^ny - 1)/(q - 1) = ly. Lengths in m. `first` = 0 or ly/ny gives 1 (uniform).
/// Mesh 1 of the paper: ly = 0.025, ny = 30, first = 2.625e-4 gives 1.0705.
/// Throws std::invalid_argument unless rows_fit.
double stretching_ratio(double ly, int ny, double first);

/// The ny + 1 faces y_j = first (q^j - 1)/(q - 1) [m]: y_0 = 0 and y_ny = ly exactly.
/// Throws as stretching_ratio.
std::vector<double> stretched_faces(double ly, int ny, double first);

}  // namespace barchan
