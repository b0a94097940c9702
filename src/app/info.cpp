#include "src/app/info.hpp"

#include <fmt/format.h>

#include <thread>

#include "src/io/frame_file.hpp"
#include "src/io/seal.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

namespace {

// Names of the element types, in the order of ElementType.
constexpr const char* kTypeNames[] = {"float32", "float64", "int32", "int64", "other"};

std::string describe_array(const Hdf5File& file, const std::string& path,
                           const std::string& label) {
  const auto info = file.info(path);
  const std::string units = file.has_attribute(path, "units")
                                ? file.attribute<std::string>(path, "units")
                                : std::string("?");
  const std::string meaning = file.has_attribute(path, "long_name")
                                  ? file.attribute<std::string>(path, "long_name")
                                  : std::string();
  const std::string line =
      fmt::format("  {:<24} {:<18} {:<8} {:<9} {}", label, to_string(info.extents),
                  kTypeNames[static_cast<int>(info.type)], fmt::format("[{}]", units), meaning);
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

// Depth of groups that is listed, more than ours have: links of a foreign file may lead in circles.
constexpr int kDeepestGroup = 4;
// Longest listing [bytes], more than any of our files holds below "/" or "grid": the text stays
// readable, and within memory.
constexpr std::size_t kLongestListing = 100000;

/// Arrays below a group, with the groups below it.
std::string describe_group(const Hdf5File& file, const std::string& group, int depth = 0) {
  std::string text;
  for (const auto& name : file.children(group)) {
    if (text.size() > kLongestListing) return text + "  ...\n";
    const std::string path = group == "/" ? name : group + "/" + name;
    if (!file.is_group(path)) {
      text += describe_array(file, path, path);
    } else if (depth < kDeepestGroup) {
      text += describe_group(file, path, depth + 1);
    } else {
      text += fmt::format("  {:<24} a group, not looked into\n", path);
    }
  }
  return text;
}

std::string describe_origin(const Provenance& origin) {
  const auto known = [](const std::string& text) { return text.empty() ? "unknown" : text; };
  return fmt::format("title    {}\nwritten  by barchan {} ({}), {}\n", known(origin.title),
                     known(origin.version), known(origin.git_hash), known(origin.backend));
}

std::string describe_frames(const Hdf5File& file, const std::vector<FrameInfo>& frames) {
  if (frames.empty()) return "frames   none yet\n";
  const auto &first = frames.front(), &last = frames.back();
  std::string text =
      fmt::format("frames   {}: {} ... {}, t = {:.6g} s (step {}) ... {:.6g} s (step {})\n",
                  frames.size(), first.name, last.name, first.t, first.step, last.t, last.step);
  text += "arrays of the last frame:\n";
  for (const auto& [name, array] : last.arrays) {
    text += describe_array(file, last.name + "/" + name, name);
  }
  if (file.exists("grid")) text += "grid:\n" + describe_group(file, "grid");
  return text;
}

/// Tells if the file has just changed: a run may be at work on it.
bool has_just_changed(const std::filesystem::path& path) {
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(path, error);
  return !error &&
         std::filesystem::file_time_type::clock::now() - changed < std::chrono::seconds{2};
}

std::string describe(const std::filesystem::path& path) {
  std::optional<CheckpointReader> restart;
  if (has_seal(path)) restart.emplace(path);  // the seal is checked before anything else is opened
  const Hdf5File file(path, Hdf5File::Mode::read);
  if (!file.has_attribute("/", "git_hash") || !file.has_attribute("/", "config")) {
    throw std::runtime_error(path.string() + " is an HDF5 file, but not one that barchan wrote");
  }
  std::string text = fmt::format("{}\n", path.string());
  const Provenance origin = read_provenance(file);
  if (file.has_attribute("/", "kind")) {
    if (!restart) restart.emplace(path);
    text += fmt::format("kind     restart file of step {}\n", restart->step());
    text += describe_origin(origin);
    if (restart->has("t")) text += fmt::format("time     {:.10g} s\n", restart->real("t"));
    text += "arrays:\n" + describe_group(file, "/");
  } else if (file.exists("body_0")) {
    text += "kind     results (bodies)\n" + describe_origin(origin) + "arrays:\n" +
            describe_group(file, "/");
  } else {
    text += fmt::format("kind     results ({})\n", file.exists("grid") ? "flow" : "grains");
    text += describe_origin(origin) + describe_frames(file, list_frames(file));
  }
  return text + "The configuration is in the attribute \"config\" of the file.\n";
}

}  // namespace

std::string describe_file(const std::filesystem::path& path, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause{20};
  for (const auto end = std::chrono::steady_clock::now() + patience;;) {
    try {
      return describe(path);
    } catch (const Hdf5Error&) {
      if (std::chrono::steady_clock::now() > end || !has_just_changed(path)) throw;
    }
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace barchan
