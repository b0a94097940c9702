#include "tests/fuzz/valid_files.hpp"

#include <numeric>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/io/frame_file.hpp"
#include "tests/fuzz/hdf5_readers.hpp"

namespace barchan::fuzz {

namespace {

constexpr std::uint64_t n_grains = 3;

Provenance provenance() {
  return {.title = "a dune",
          .config = "[time]\nend = 1\n",
          .version = "0",
          .git_hash = "0",
          .backend = "none"};
}

template <class T>
std::vector<T> numbers(std::uint64_t n) {
  std::vector<T> values(n);
  std::iota(values.begin(), values.end(), T{1});
  return values;
}

}  // namespace

std::filesystem::path write_restart(const std::filesystem::path& folder) {
  CheckpointWriter file(folder, 7, provenance());
  for (const auto& array : state_arrays) {
    const Extents extents = array.components > 0
                                ? Extents{n_grains, static_cast<std::uint64_t>(array.components)}
                                : Extents{n_grains};
    const auto n =
        std::accumulate(extents.begin(), extents.end(), std::uint64_t{1}, std::multiplies<>());
    if (array.integers) {
      file.array(array.name, numbers<std::int64_t>(n), extents);
    } else {
      file.array(array.name, numbers<double>(n), extents);
    }
  }
  for (const auto* name : state_numbers) file.scalar(name, 0.5);
  for (const auto* name : state_integers) file.scalar(name, std::int64_t{3});
  return file.commit(1);
}

std::filesystem::path write_frames(const std::filesystem::path& folder) {
  const auto path = folder / "grains.h5";
  FrameFile file(path, provenance(), {}, MPI_COMM_SELF);
  for (const int frame : {0, 1}) {
    file.append(
        0.1 * frame, 10 * frame, [](Hdf5File&) {},
        [](Hdf5File& h5, const std::string& group) {
          h5.write<std::int64_t>(group + "/id", numbers<std::int64_t>(n_grains), {n_grains}, "1");
          h5.write<float>(group + "/d", numbers<float>(n_grains), {n_grains}, "m");
          for (const char* name : {"/x", "/u", "/omega"}) {
            h5.write<double>(group + name, numbers<double>(3 * n_grains), {n_grains, 3}, "SI");
          }
        });
  }
  return path;
}

}  // namespace barchan::fuzz
