// How the cells are shared among the ranks.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

TEST(Decomposition, SplitsAreEvenAndComplete) {
  for (const int n : {1, 2, 7, 63, 250}) {
    for (int parts = 1; parts <= 9; ++parts) {
      const Split split{.n = n, .parts = parts};
      EXPECT_EQ(split.begin(0), 0);
      EXPECT_EQ(split.begin(parts), n);
      for (int p = 0; p < parts; ++p) {
        EXPECT_LE(split.count(p), split.count(0));
        EXPECT_GE(split.count(p), split.count(0) - 1);
      }
    }
  }
}

TEST(Decomposition, EveryColumnHasOneOwner) {
  const test::SharedGrid grid({11, 3, 13}, {0.11, 0.03, 0.13}, 0);
  int n = grid.mine.nx * grid.mine.nz, all = 0;
  MPI_Allreduce(&n, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, 11 * 13);
  EXPECT_GE(grid.mine.nx, 2);
  EXPECT_GE(grid.mine.nz, 2);
  // The rank behind along x begins where this one ends.
  const RankLine& line = grid.ranks->along_x();
  int next = 0, end = (grid.mine.i_begin + grid.mine.nx) % 11;
  MPI_Sendrecv(&grid.mine.i_begin, 1, MPI_INT, line.before(), 0, &next, 1, MPI_INT, line.after(), 0,
               line.communicator, MPI_STATUS_IGNORE);
  EXPECT_EQ(next, end);
}

TEST(Decomposition, TooThinPencilsAreRefused) {
  const int count = rank_count(MPI_COMM_WORLD);
  if (count == 1) GTEST_SKIP() << "one rank fits everywhere";
  try {
    const Decomposition thin(MPI_COMM_WORLD, 3, 3);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(count) + " ranks cannot share 3 x 3"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace barchan
