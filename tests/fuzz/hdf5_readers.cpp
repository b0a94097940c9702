#include "tests/fuzz/hdf5_readers.hpp"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is of POSIX
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string_view>

#include "src/grains/grain_files.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/frame_file.hpp"
#include "src/io/hdf5_handle.hpp"
#include "src/run/info.hpp"
#include "tests/fuzz/sound_grains.hpp"

namespace barchan::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view folder_prefix = "barchan_fuzz_";

/// The folder of this process's inputs. It goes at the end, and what processes that crashed have
/// left goes with the next one.
struct InputFolder {
  fs::path path;
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;
  InputFolder() {
    const fs::path in_memory = "/dev/shm";
    const fs::path base = fs::is_directory(in_memory) ? in_memory : fs::temp_directory_path();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(base)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(folder_prefix)) continue;
      int owner = 0;
      std::from_chars(name.data() + folder_prefix.size(), name.data() + name.size(), owner);
      if (owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH) fs::remove_all(entry, ignored);
    }
    path = base / (std::string(folder_prefix) + std::to_string(::getpid()));
    fs::create_directory(path);
  }
  ~InputFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

herr_t mark_complaint(unsigned, const H5E_error2_t* entry, void*) {
  mark(std::hash<std::string_view>{}(entry->func_name) + std::size_t{31} * entry->line);
  return 0;
}
herr_t mark_complaints(hid_t stack, void*) {
  H5Ewalk2(stack, H5E_WALK_DOWNWARD, mark_complaint, nullptr);
  return 0;
}

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
        accepts([&] { file.read_block<double>(path, whole, Extents(whole.size(), 0), whole); });
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
  accepts([&] { file.part<T>(array.name, wanted, Extents(wanted.size(), 0), wanted); });
}

void read_restart(const fs::path& path) {
  const CheckpointReader file(path);
  accepts([&] { file.step(); });
  accepts([&] { file.provenance(); });
  for (const auto* name : state_numbers) accepts([&] { file.real(name); });
  for (const auto* name : state_integers) accepts([&] { file.integer(name); });
  for (const auto& array : state_arrays) {
    accepts([&] { file.has(array.name); });
    if (array.integers) {
      read_state_array<std::int64_t>(file, array);
    } else {
      read_state_array<double>(file, array);
    }
  }
}

}  // namespace

fs::path input_file(const char* name) {
  static const InputFolder folder;
  return folder.path / name;
}

void write_input(const fs::path& file, const void* data, std::size_t size) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  stream.close();
  demand(stream.good(), "the input is on the disk");
}

void watch_library() {
  static const bool watched = [] {
    hdf5::start_library();
    H5Eset_auto2(H5E_DEFAULT, mark_complaints, nullptr);
    return true;
  }();
  static_cast<void>(watched);
}

void read_as_everything(const fs::path& file) {
  accepts([&] { demand_sound(read_grains(file)); });
  accepts([&] { describe_file(file); });
  accepts([&] { read_results(file); });
  accepts([&] { read_restart(file); });
}

}  // namespace barchan::fuzz
