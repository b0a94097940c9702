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

constexpr std::string_view kFrame = "frame_000000", kGroup = "frame_group_000";
constexpr int kGroupSize = Hdf5File::kGroupLinks;
constexpr int kMostFrames = 1000 * kGroupSize;

std::string name_of(int frame) {
  const std::string name = fmt::format("frame_{:06}", frame);
  return frame < kGroupSize ? name : fmt::format("frame_group_{:03}/{}", frame / kGroupSize, name);
}

std::string_view letters_of(std::string_view sample) { return sample.substr(0, sample.find('0')); }

/// Number in a name as `sample`, where each digit is 0; -1 for any other name.
int number_in(std::string_view name, std::string_view sample) {
  int number = -1;
  if (!name.starts_with(letters_of(sample))) return -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + letters_of(sample).size(), end, number);
  return error == std::errc() && stop == end ? number : -1;
}

int frame_number(std::string_view path) {
  const auto slash = path.find('/');
  return number_in(slash == std::string_view::npos ? path : path.substr(slash + 1), kFrame);
}

/// True for a name that one wrong bit may have made of a frame's or a group's, which must not be
/// missed.
bool is_nearly(std::string_view sample, const std::string& name) {
  if (name.size() != sample.size()) return false;
  std::size_t right = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool digit = name[i] >= '0' && name[i] <= '9';
    if (sample[i] != '0' ? name[i] == sample[i] : digit) ++right;
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
  using Name = std::pair<int, std::string>;
  std::vector<Name> names;
  const auto collect = [&](const std::string& group) {  // returns the groups of frames in it
    std::vector<std::string> groups;
    for (const auto& name : file.children(group.empty() ? "/" : group)) {
      const std::string path = group.empty() ? name : group + "/" + name;
      if (const int number = frame_number(name); number >= 0) names.emplace_back(number, path);
      if (number_in(name, kGroup) >= 0) groups.push_back(name);
      if (is_nearly(kFrame, name) || (group.empty() && is_nearly(kGroup, name)))
        refuse(file, "\"" + path + "\" is not the name of a frame");
    }
    return groups;
  };
  for (const auto& group : collect("")) collect(group);
  std::sort(names.begin(), names.end());  // by number
  if (std::ranges::adjacent_find(names, {}, &Name::first) != names.end())
    refuse(file, "two of its frames have the same number");
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
  bool has_room = false;
  {
    const Hdf5File file(path_, Hdf5File::Mode::read, communicator_);
    frames_ = list_frames(file);
    has_room = file.has_room();
  }
  made_ = true;
  bring_up_to_date(*restart_time, has_room);
  if (frames_.empty()) return;
  next_ = frame_number(frames_.back().name) + 1;
  write_description();  // frames may have been dropped
}

void FrameFile::write_description() const {
  if (describe_ == nullptr || rank_of(communicator_) != 0) return;
  const auto beside = std::filesystem::path(path_).replace_extension(".xdmf");
  write_atomically(beside, describe_(path_.filename().string(), frames_));
}

void FrameFile::bring_up_to_date(double t, bool has_room) {
  const auto late = [t](const FrameInfo& frame) { return frame.t > last_same_time(t); };
  if (std::erase_if(frames_, late) == 0 && has_room) return;
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
      if (frame_number(name) < 0 && number_in(name, kGroup) < 0) file.copy_from(old, name, name);
    }
    for (auto& frame : frames_) {
      const std::string name = name_of(frame_number(frame.name));
      if (const auto slash = name.find('/'); slash != std::string::npos)
        file.make_group(name.substr(0, slash), Hdf5File::kGroupLinks);
      file.copy_from(old, std::exchange(frame.name, name), name);
    }
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
  const std::string name = name_of(next_);
  file.begin_hidden_group(name);
  file.set_attribute(name, "time", t);
  file.set_attribute(name, "step", step);
  content(file, name);
  FrameInfo frame = read_frame(file, name);
  file.publish_group();
  return frame;
}

void FrameFile::append(double t, std::int64_t step, const Preamble& preamble,
                       const Content& content) {
  FrameInfo frame;
  if (next_ == kMostFrames) {
    throw Hdf5Error(fmt::format(
        "cannot write {}: it holds {} frames, the most that one file takes: go on in another "
        "--out, or with a longer interval",
        path_.string(), kMostFrames));
  }
  if (made_) {
    Hdf5File file(path_, Hdf5File::Mode::modify, communicator_);
    frame = write_frame(file, t, step, content);
  } else {  // it gets its name with its first frame
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
