// Gathering of the grains of all ranks on rank 0, for analyses that need all of them at once.
#pragma once

#include <vector>

#include "src/diagnostics/dune_map.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

/// Shares of the ranks in a gathered list: the number of entries of each rank, and the offset of
/// its first; empty on ranks other than 0.
struct RankShares {
  std::vector<int> counts, offsets{0};
  RankShares(MPI_Comm ranks, int n) : counts(static_cast<std::size_t>(rank_count(ranks))) {
    MPI_Gather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, ranks);
    for (const int count : counts) offsets.push_back(offsets.back() + count);
  }
};

/// Gathers rows of doubles of all ranks on rank 0, one rank after the other; empty on other ranks.
/// All ranks call it together.
template <class Row>
std::vector<Row> on_rank_0(MPI_Comm ranks, const std::vector<Row>& mine) {
  if (rank_count(ranks) == 1) return mine;
  constexpr std::size_t width = sizeof(Row) / sizeof(double);
  const int n = static_cast<int>(mine.size() * width);
  const RankShares of(ranks, n);
  std::vector<Row> all(static_cast<std::size_t>(of.offsets.back()) / width);
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, all.data(), of.counts.data(), of.offsets.data(),
              MPI_DOUBLE, 0, ranks);
  return all;
}

/// Returns to each rank the numbers of its n rows. Rank 0 has a number for each row of all ranks,
/// in the order of on_rank_0(). All ranks call it together.
inline std::vector<int> from_rank_0(MPI_Comm ranks, const std::vector<int>& all, int n) {
  if (rank_count(ranks) == 1) return all;
  const RankShares of(ranks, n);
  std::vector<int> mine(static_cast<std::size_t>(n));
  MPI_Scatterv(all.data(), of.counts.data(), of.offsets.data(), MPI_INT, mine.data(), n, MPI_INT, 0,
               ranks);
  return mine;
}

/// All grains as the dune analytics take them, clumps as spheres of their volume; empty on ranks
/// other than 0. Those of a rank have the order of whole_grains(). All ranks call it together.
inline std::vector<GrainSample> gathered_grains(const GrainState& grains) {
  const GrainState whole = whole_grains(grains);
  const auto kin = host_copy(whole.kin);
  const auto heap = host_copy(whole.heap);
  std::vector<GrainSample> mine;
  for (int g = 0; g < whole.n; ++g) {
    mine.push_back({.x = kin(g).x,
                    .d = 2 * kin(g).r,
                    .u_x = kin(g).u.x,
                    .heap = heap.size() > 0 && heap(g) != kNoHeap ? Real(heap(g)) : Real(-1)});
  }
  return on_rank_0(grains.ranks, mine);
}

}  // namespace barchan
