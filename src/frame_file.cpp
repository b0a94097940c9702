#include "src/frame_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace barchan {

namespace {

const std::string prefix = "frame_";

/// Number of a frame's group; -1 for any other name.
int frame_number(const std::string& name) {
  int number = -1;
  if (!name.starts_with(prefix)) return -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
  return error == std::errc() && stop == end ? number : -1;
}

FrameInfo read_frame(const Hdf5File& file, const std::string& name) {
  FrameInfo frame{.name = name,
                  .t = file.real_attribute(name, "time"),
                  .step = file.integer_attribute(name, "step"),
                  .arrays = {}};
  for (const auto& array : file.children(name)) {
    frame.arrays.push_back({array, file.info(name + "/" + array)});
  }
  return frame;
}

}  // namespace

std::vector<FrameInfo> list_frames(const Hdf5File& file) {
  std::vector<std::pair<int, std::string>> names;
  for (const auto& name : file.children()) {
    if (const int number = frame_number(name); number >= 0) names.emplace_back(number, name);
  }
  std::sort(names.begin(), names.end());  // by number, also beyond 999999
  std::vector<FrameInfo> frames;
  for (const auto& [number, name] : names) frames.push_back(read_frame(file, name));
  return frames;
}

FrameFile::FrameFile(std::filesystem::path path, Provenance provenance,
                     std::optional<double> restart_time, MPI_Comm communicator)
    : path_(std::move(path)), provenance_(std::move(provenance)), communicator_(communicator) {
  if (!restart_time || !std::filesystem::exists(path_)) return;
  {
    const Hdf5File file(path_, Hdf5File::Mode::read, communicator_);
    frames_ = list_frames(file);
  }
  made_ = true;
  drop_after(*restart_time);
  if (!frames_.empty()) next_ = frame_number(frames_.back().name) + 1;
}

void FrameFile::drop_after(double t) {
  const auto late = [last = t + 1e-9 * std::max(1.0, std::abs(t))](const FrameInfo& frame) {
    return frame.t > last;
  };
  if (std::none_of(frames_.begin(), frames_.end(), late)) return;
  Hdf5File file(path_, Hdf5File::Mode::modify, communicator_);
  for (const auto& frame : frames_) {
    if (late(frame)) file.remove(frame.name);
  }
  file.close();
  std::erase_if(frames_, late);
}

void FrameFile::append(double t, std::int64_t step, const Preamble& preamble,
                       const Content& content) {
  if (!made_) {
    Hdf5File file(path_, Hdf5File::Mode::create, communicator_);
    write_provenance(file, provenance_);
    preamble(file);
    file.close();
    made_ = true;
  }
  const std::string name = fmt::format("{}{:06}", prefix, next_);
  Hdf5File file(path_, Hdf5File::Mode::modify, communicator_);
  file.begin_hidden_group(name);
  file.set_attribute(name, "time", t);
  file.set_attribute(name, "step", step);
  content(file, name);
  file.publish_group();
  FrameInfo frame = read_frame(file, name);
  file.close();
  frames_.push_back(std::move(frame));
  ++next_;
}

}  // namespace barchan
