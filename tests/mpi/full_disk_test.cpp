#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "src/io/hdf5_file.hpp"
#include "src/parallel/communicator.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/shared_folder.hpp"

namespace barchan {
namespace {

using test::SharedFolder;

// One rank cannot write its part of the library's own tables, which are written when the file is
// closed: it says so, while the others wait within the library. ctest runs it alone, as
// mpi.full_disk, and looks for the words.
TEST(FullDisk, DISABLED_IsTheErrorOfOneRankAtTheClose) {
  const SharedFolder folder;
  Hdf5File file(folder.path() / "tables.h5", Hdf5File::Mode::create, MPI_COMM_WORLD);
  const std::vector<double> values(100);
  for (int n = 0; n < 50; ++n)
    file.write<double>("group " + std::to_string(n) + "/array", values, {100}, "1");
  const FileSizeLimit full(rank_of(MPI_COMM_WORLD) == 1 ? 1000 : RLIM_INFINITY);
  try {
    file.close();
  } catch (const Hdf5Error& problem) {
    std::cerr << "rank " << rank_of(MPI_COMM_WORLD) << ": " << problem.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  FAIL() << "closed a file of which a rank could not write its part";
}

}  // namespace
}  // namespace barchan
