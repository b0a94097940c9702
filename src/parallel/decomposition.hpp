// Decomposition of the grid into pencils, one for each rank.
#pragma once

#include <mpi.h>

#include "kernels/math/block_partition.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// Ranks side by side along one periodic direction.
struct RankAxis {
  MPI_Comm communicator = MPI_COMM_NULL;
  int count = 1, position = 0;
  int lower() const { return (position + count - 1) % count; }
  int upper() const { return (position + 1) % count; }
};

/// Decomposition of nx x nz columns of cells into pencils of full height, one for each rank. Its
/// shape is the cheapest one, so results on a number of ranks do not depend on anything else.
class Decomposition {
 public:
  /// Smallest number of cells across a pencil along a direction that is cut.
  static constexpr int kThinnest = 2;
  /// Tells if so many cells can be cut into so many parts.
  static bool is_thick_enough(int cells, int parts) {
    return parts == 1 || cells / parts >= kThinnest;
  }

  /// Divides the grid among all ranks of `all`, which call this together. Throws std::runtime_error
  /// if there are too many of them for pencils of kThinnest cells; it says how many there may be.
  /// `along_x`: so many ranks along x, a divisor of their number; 0: as many as cost least.
  Decomposition(MPI_Comm all, int nx, int nz, int along_x = 0);
  ~Decomposition();
  Decomposition(const Decomposition&) = delete;
  Decomposition& operator=(const Decomposition&) = delete;

  const BlockPartition& x() const { return x_; }
  const BlockPartition& z() const { return z_; }
  /// Ranks with the same z as this one, then those with the same x.
  const RankAxis& along_x() const { return along_x_; }
  const RankAxis& along_z() const { return along_z_; }
  MPI_Comm all() const { return all_; }

 private:
  BlockPartition x_, z_;
  RankAxis along_x_, along_z_;
  MPI_Comm all_ = MPI_COMM_NULL;
};

/// Ranks that share a grid; this one alone where it has all of it.
inline MPI_Comm ranks_of(const Grid& grid) {
  return grid.ranks ? grid.ranks->all() : MPI_COMM_SELF;
}
inline int rank_of(const Grid& grid) { return rank_of(ranks_of(grid)); }

}  // namespace barchan
