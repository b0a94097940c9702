#include "tests/fuzz/hdf5_files.hpp"
#include "src/initial/grain_files.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <string_view>
#include <vector>

#include "src/app/info.hpp"
#include "src/io/frame_file.hpp"
#include "src/restart/checkpoint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan::fuzz {

namespace fs = std::filesystem;

namespace {

/// The arrays and numbers that a restart asks for.
struct StateArray {
  const char* name;
  bool integers;
  int components;  // of one element; 0: one row of numbers
};
constexpr StateArray state_arrays[] = {
    {"grains/id", true, 0},           {"grains/kin", false, 12},
    {"grains/x_reference", false, 3}, {"grains/wall_touching", true, 0},
    {"grains/wall_xi_t", false, 6},   {"grains/of_rank", true, 0},
    {"contacts/first", true, 0},      {"contacts/second", true, 0},
    {"contacts/xi_t", false, 3},      {"dunes", false, 0},
    {"fluid/u_x", false, 0},          {"fluid/p", false, 0},
    {"feed/bodies", false, 3},        {"feed/waiting", false, 3}};
constexpr const char* state_numbers[] = {"grains/r_max",  "grains/r_min", "fluid/time", "t",
                                         "grains/seam_x", "feed/due"};
constexpr const char* state_integers[] = {"step",        "grains/n_initial", "grains/n_left",
                                          "feed/n_fed",  "feed/next_id",     "feed/n_tries",
                                          "feed/n_asked"};

/// Every array below a group, as the type it says it has; `depth` against links in circles.
void read_arrays(const Hdf5File& file, const std::string& group, int depth) {
  for (const auto& name : file.children(group)) {
    const std::string path = group == "/" ? name : group + "/" + name;
    accepts([&] {
      if (!file.is_group(path)) {
        accepts([&] { file.read<double>(path); });
        accepts([&] { file.read<float>(path); });
        accepts([&] { file.read<std::int64_t>(path); });
        const Extents whole = file.info(path).extents;
        accepts([&] { file.read<double>(path, whole, Extents(whole.size(), 0), whole); });
      } else if (depth > 0) {
        read_arrays(file, path, depth - 1);
      }
    });
  }
}

void read_results(const fs::path& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  accepts([&] { list_frames(file); });
  accepts([&] { read_provenance(file); });
  read_arrays(file, "/", 2);
}

template <class T>
void read_state_array(const CheckpointReader& file, const StateArray& array) {
  Extents whole;
  accepts([&] { whole = file.extents(array.name); });
  accepts([&] { file.array<T>(array.name); });
  Extents wanted = whole;
  if (array.components > 0)
    wanted = {whole.empty() ? 0 : whole.front(), std::uint64_t(array.components)};
  accepts([&] { file.array<T>(array.name, wanted); });
  accepts([&] { file.array<T>(array.name, wanted, Extents(wanted.size(), 0), wanted); });
}

void read_restart(const fs::path& path) {
  const CheckpointReader file(path);
  accepts([&] { file.step(); });
  accepts([&] { file.provenance(); });
  for (const auto* name : state_numbers) accepts([&] { file.real(name); });
  for (const auto* name : state_integers) accepts([&] { file.integer(name); });
  for (const auto& array : state_arrays) {
    accepts([&] { file.has(array.name); });
    read_state_array<std::int64_t>(file, array);
    read_state_array<double>(file, array);
  }
}

constexpr std::uint64_t n_grains = 3;

const Provenance origin{"a dune", "[time]\nend = 1\n", "0", "0", "none"};

template <class T>
std::vector<T> numbers(std::uint64_t n) {
  std::vector<T> values(n);
  std::iota(values.begin(), values.end(), T{1});
  return values;
}

}  // namespace

fs::path input_file(const char* name) {
  static const TemporaryFolder folder;
  return folder / name;
}

void write_input(const fs::path& file, const void* data, std::size_t size) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  stream.close();
  demand(stream.good(), "the input is on the disk");
}

void read_as_everything(const fs::path& file) {
  accepts([&] { demand_sound(read_grains(file)); });
  accepts([&] { describe_file(file, {}); });
  accepts([&] { read_results(file); });
  accepts([&] { read_restart(file); });
}

fs::path write_restart(const fs::path& folder) {
  CheckpointWriter file(folder, 7, origin);
  for (const auto& array : state_arrays) {
    const auto components = static_cast<std::uint64_t>(array.components);
    Extents extents{n_grains};
    if (components > 0) extents.push_back(components);
    const auto n = n_grains * std::max<std::uint64_t>(components, 1);
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

fs::path write_frames(const fs::path& folder) {
  const auto path = folder / "grains.h5";
  FrameFile file(path, origin, {}, MPI_COMM_SELF);
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
