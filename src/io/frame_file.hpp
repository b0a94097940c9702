// An HDF5 file that grows by frames: /frame_000000 to /frame_000249, then, in groups of 250,
// /frame_group_001/frame_000250, ... A program that knows no groups stumbles over their names: it
// must not take the first frames for all.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/io/hdf5_file.hpp"

namespace barchan {

struct FrameInfo {
  std::string name;  // "frame_000012", "frame_group_001/frame_000262"
  double t = 0;      // [s]
  std::int64_t step = 0;
  std::map<std::string, ArrayInfo> arrays;
};

/// The frames of an open result file in order of their number. Throws Hdf5Error.
std::vector<FrameInfo> list_frames(const Hdf5File& file);

class FrameFile {
 public:
  /// Text for viewers about the frames of a file (fields_xdmf), kept beside it as .xdmf.
  using Describe = std::string (*)(const std::string& h5_name, const std::vector<FrameInfo>&);

  /// `restart_time`: as for OutputFiles. Throws Hdf5Error.
  FrameFile(std::filesystem::path path, Provenance provenance, std::optional<double> restart_time,
            MPI_Comm communicator, Describe describe = nullptr);

  /// Writes once, when the file is made, after the provenance; may be empty.
  using Preamble = std::function<void(Hdf5File&)>;
  /// Writes the arrays of a frame below `group`.
  using Content = std::function<void(Hdf5File&, const std::string& group)>;

  /// Appends one frame. Throws Hdf5Error; the earlier frames stay readable.
  void append(double t, std::int64_t step, const Preamble& preamble, const Content& content);

  const std::vector<FrameInfo>& frames() const { return frames_; }

 private:
  /// Frames after t go; a file with the tables of an earlier version gets those of this one.
  void bring_up_to_date(double t, bool has_room);
  /// Makes a new file beside and gives it the name when it is complete.
  void replace_file(const Preamble& fill) const;
  void write_description() const;
  FrameInfo write_frame(Hdf5File& file, double t, std::int64_t step, const Content& content) const;

  std::filesystem::path path_;
  Provenance provenance_;
  MPI_Comm communicator_;
  Describe describe_;
  bool made_ = false;  // the file on the disk is this run's
  int next_ = 0;       // number of the next frame
  std::vector<FrameInfo> frames_;
};

}  // namespace barchan
