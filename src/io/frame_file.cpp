#include "src/io/frame_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "src/base/atomic_file.hpp"
#include "src/base/same_time.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

constexpr std::string_view kFramePrefix = "frame_";

/// Number of a frame's group; -1 for any other name.
int frame_number(const std::string& name) {
  int number = -1;
  if (!name.starts_with(kFramePrefix)) return -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + kFramePrefix.size(), end, number);
  return error == std::errc() && stop == end ? number : -1;
}

/// True for a name that one wrong bit may have made of a frame's: the frame must not be missed.
bool is_nearly_a_frame(const std::string& name) {
  constexpr std::string_view sample = "frame_000000";
  if (name.size() != sample.size()) return false;
  std::size_t right = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool digit = name[i] >= '0' && name[i] <= '9';
    if (i < kFramePrefix.size() ? name[i] == sample[i] : digit) ++right;
  }
  return right == name.size() - 1;
}

[[noreturn]] void refuse(const Hdf5File& file, const std::string& why) {
  throw Hdf5Error("cannot read " + file.path().string() + ": it is damaged: " + why);
}

FrameInfo read_frame(const Hdf5File& file, const std::string& name) {
  FrameInfo frame{.name = name,
                  .t = file.attribute<double>(name, "time"),
                  .step = file.attribute<std::int64_t>(name, "step"),
                  .arrays = {}};
  for (const auto& array : file.children(name)) {
    frame.arrays[array] = file.info(name + "/" + array);
  }
  return frame;
}

}  // namespace

std::vector<FrameInfo> list_frames(const Hdf5File& file) {
  std::vector<std::pair<int, std::string>> names;
  for (const auto& name : file.children()) {
    if (const int number = frame_number(name); number >= 0) names.emplace_back(number, name);
    if (is_nearly_a_frame(name)) refuse(file, "\"" + name + "\" is not the name of a frame");
  }
  std::sort(names.begin(), names.end());  // by number, also beyond 999999
  std::vector<FrameInfo> frames;
  for (const auto& [number, name] : names) frames.push_back(read_frame(file, name));
  if (!std::ranges::is_sorted(frames, {}, &FrameInfo::step)) {
    refuse(file, "its frames are not in the order of their steps");
  }
  return frames;
}

FrameFile::FrameFile(std::filesystem::path path, Provenance provenance,
                     std::optional<double> restart_time, MPI_Comm communicator, Describe describe)
    : path_(std::move(path)),
      provenance_(std::move(provenance)),
      communicator_(communicator),
      describe_(describe) {
  if (!restart_time || !std::filesystem::exists(path_)) return;
  frames_ = list_frames(Hdf5File(path_, Hdf5File::Mode::read, communicator_));
  made_ = true;
  drop_after(*restart_time);
  if (frames_.empty()) return;
  next_ = frame_number(frames_.back().name) + 1;
  write_description();  // frames may have been dropped
}

void FrameFile::write_description() const {
  if (describe_ == nullptr || rank_of(communicator_) != 0) return;
  const auto beside = std::filesystem::path(path_).replace_extension(".xdmf");
  write_atomically(beside, describe_(path_.filename().string(), frames_));
}

void FrameFile::drop_after(double t) {
  const auto late = [t](const FrameInfo& frame) { return frame.t > last_same_time(t); };
  if (std::erase_if(frames_, late) == 0) return;
  made_ = !frames_.empty();
  if (!made_) {  // the next frame begins a new file
    if (rank_of(communicator_) == 0) std::filesystem::remove(path_);
    return;
  }
  // Links are not removed in place: a kill while they are could cost the frames that stay.
  replace_file([&](Hdf5File& file) {
    const Hdf5File old(path_, Hdf5File::Mode::read, communicator_);
    write_provenance(file, provenance_);
    for (const auto& name : old.children()) {
      if (frame_number(name) < 0) file.copy_from(old, name);
    }
    for (const auto& frame : frames_) file.copy_from(old, frame.name);
  });
}

void FrameFile::replace_file(const Preamble& fill) const {
  const auto beside = std::filesystem::path(path_).concat(".tmp");
  const bool root = rank_of(communicator_) == 0;
  try {
    Hdf5File file(beside, Hdf5File::Mode::create, communicator_);
    fill(file);
    file.close();
    if (root) std::filesystem::rename(beside, path_);
    synchronise(communicator_);
  } catch (...) {
    std::error_code ignored;
    if (root) std::filesystem::remove(beside, ignored);
    throw;
  }
}

FrameInfo FrameFile::write_frame(Hdf5File& file, double t, std::int64_t step,
                                 const Content& content) const {
  const std::string name = fmt::format("{}{:06}", kFramePrefix, next_);
  file.begin_hidden_group(name);
  file.set_attribute(name, "time", t);
  file.set_attribute(name, "step", step);
  content(file, name);
  file.publish_group();
  return read_frame(file, name);
}

void FrameFile::append(double t, std::int64_t step, const Preamble& preamble,
                       const Content& content) {
  FrameInfo frame;
  if (made_) {
    Hdf5File file(path_, Hdf5File::Mode::modify, communicator_);
    frame = write_frame(file, t, step, content);
    file.close();
  } else {
    // The first link also makes the root's table, which is not safe against a kill as the later
    // ones are: the file gets its name with its first frame.
    replace_file([&](Hdf5File& file) {
      write_provenance(file, provenance_);
      if (preamble) preamble(file);
      frame = write_frame(file, t, step, content);
    });
  }
  made_ = true;
  frames_.push_back(std::move(frame));
  ++next_;
  write_description();
}

}  // namespace barchan
