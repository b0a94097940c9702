// A folder for files that all ranks write together.
#pragma once

#include <mpi.h>

#include <array>
#include <optional>

#include "src/parallel/communicator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan::test {

/// A folder that rank 0 makes and all ranks know.
class SharedFolder {
 public:
  SharedFolder() {
    std::array<char, 512> name{};
    if (rank_of(MPI_COMM_WORLD) == 0) {
      own_.emplace();
      own_->path().string().copy(name.data(), name.size() - 1);
    }
    MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    path_ = name.data();
  }
  ~SharedFolder() { MPI_Barrier(MPI_COMM_WORLD); }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::optional<TemporaryFolder> own_;
  std::filesystem::path path_;
};

}  // namespace barchan::test
