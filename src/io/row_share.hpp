// Rows of all ranks one after the other in one array of a file.
#pragma once

#include <cstdint>

#include "src/io/hdf5_file.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

/// This rank's n rows among those of all ranks; the default share on one rank.
inline Share share_of_rows(std::uint64_t n, MPI_Comm ranks) {
  if (rank_count(ranks) == 1) return {};
  std::uint64_t before = 0, all = 0;
  MPI_Exscan(&n, &before, 1, MPI_UINT64_T, MPI_SUM, ranks);
  MPI_Allreduce(&n, &all, 1, MPI_UINT64_T, MPI_SUM, ranks);
  return {.whole = {all}, .first = {rank_of(ranks) == 0 ? 0 : before}};
}

/// The share of an array of `extents`, one of which is that of the rows.
inline Share share_of(const Share& rows, const Extents& extents, std::size_t row_dimension) {
  if (rows.whole.empty()) return {};
  Share share{.whole = extents, .first = Extents(extents.size(), 0)};
  share.whole[row_dimension] = rows.whole[0];
  share.first[row_dimension] = rows.first[0];
  return share;
}

}  // namespace barchan
