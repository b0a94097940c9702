// fields.h5 and grains.h5 with their XDMF descriptions (formats: docs/files.md).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/fluid/fluid_state.hpp"
#include "src/io/frame_file.hpp"
#include "src/results/grain_outputs.hpp"
#include "src/results/output_case.hpp"

namespace barchan {

/// A cell-centred field of a frame (a mean, a second moment).
struct NamedField : Output {
  const Field* field = nullptr;
};

/// Appends frames. Each is complete on the disk or not there at all; earlier frames survive a kill
/// at any moment. Files are open only while a frame is written, so that viewers can look.
/// Collective over the communicator. Members throw Hdf5Error or std::runtime_error with the reason.
class OutputFiles {
 public:
  /// `restart_time` empty: a new run, files of an earlier one are replaced at the first frame.
  /// Otherwise frames later than it are dropped and numbering goes on. Positions are written as the
  /// images within `box`, but where something has gone wrong.
  OutputFiles(const std::filesystem::path& folder, const Provenance& provenance,
              std::optional<double> restart_time = {}, MPI_Comm communicator = MPI_COMM_SELF,
              const PeriodicBox& box = {}, std::span<const SliceConfig> slices = {});

  /// u, v, w at the cell centres (mean of the two faces), p, alpha_f, nu_t; single precision.
  /// Upper faces are read from the ghost layer, which must be valid.
  void write_fields(const FluidState& fluid, double t, std::int64_t step);

  /// Writes the fields of one layer of cells, slice_NAME.h5.
  void write_slice(const SliceConfig& slice, const FluidState& fluid, double t, std::int64_t step);

  /// Grains [0, n): id, x and d in double precision, u, omega and forces in single precision.
  void write_grains(const GrainState& grains, double t, std::int64_t step,
                    const ForceArrays& forces = {}, const DuneLabels& dunes = {});

  /// tracks.h5: ids, dunes and positions, these in single precision.
  void write_tracks(const GrainState& grains, double t, std::int64_t step,
                    const DuneLabels& dunes = {});

  /// flow_average.h5: one frame, replaced as a whole. `attributes`: numbers kept with the frame.
  void write_average(const Grid& grid, double t, std::int64_t step,
                     std::span<const NamedField> fields,
                     const std::map<std::string, double>& attributes) const;

  /// failure_fields.h5 and failure_grains.h5, one frame each with its .xdmf: a state that has gone
  /// wrong, to look at. Either part may be missing. Returns the names to open.
  std::vector<std::string> write_failure(const FluidState* fluid, const GrainState* grains,
                                         double t, std::int64_t step) const;

 private:
  /// A file of one frame, replaced as a whole.
  FrameFile anew(const std::string& name, FrameFile::Describe describe) const;

  std::filesystem::path folder_;
  Provenance provenance_;
  MPI_Comm communicator_;
  PeriodicBox box_;
  FrameFile fields_, grains_, tracks_;
  std::map<std::string, FrameFile> slices_;
};

}  // namespace barchan
