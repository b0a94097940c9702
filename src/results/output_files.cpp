#include "src/results/output_files.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "kernels/diagnostics/frame_values.hpp"
#include "src/io/xdmf.hpp"
#include "src/parallel/mirror.hpp"
#include "src/results/flow_outputs.hpp"

namespace barchan {

namespace {

using Cells = Kokkos::MDRangePolicy<Kokkos::Rank<3, Kokkos::Iterate::Left, Kokkos::Iterate::Left>>;
/// Cells [first, last) along x, y and z.
struct CellBlock {
  std::array<int, 3> first, last;
  int count(int axis) const { return last[axis] - first[axis]; }
};

CellBlock all_cells(const Grid& grid) { return {{0, 0, 0}, {grid.nx_all, grid.ny, grid.nz_all}}; }

/// The cells of a block that this rank has, numbered from its own first one; there may be none.
CellBlock own_cells(const CellBlock& block, const Grid& grid) {
  const std::array<int, 3> begin{grid.i_begin, 0, grid.k_begin}, n{grid.nx, grid.ny, grid.nz};
  CellBlock own{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    own.first[axis] = std::clamp(block.first[axis] - begin[axis], 0, n[axis]);
    own.last[axis] = std::clamp(block.last[axis] - begin[axis], own.first[axis], n[axis]);
  }
  return own;
}

/// Brings one field after the other to the host and into the group of a frame.
class FieldWriter {
 public:
  FieldWriter(Hdf5File& file, std::string group, const Grid& grid, const CellBlock& block)
      : file_(file),
        group_(std::move(group)),
        own_(own_cells(block, grid)),
        cells_({own_.first[0], own_.first[1], own_.first[2]},
               {own_.last[0], own_.last[1], own_.last[2]}),
        values_("output: frame field", size(own_.count(0)), size(own_.count(1)),
                size(own_.count(2))),
        extents_{size(own_.count(2)), size(own_.count(1)), size(own_.count(0))} {
    if (!grid.ranks) return;
    const auto place = [&](int axis, int begin) {  // of the first own cell in the block
      return values_.size() > 0 ? size(begin + own_.first[axis] - block.first[axis]) : 0;
    };
    slab_ = {.whole = {size(block.count(2)), size(block.count(1)), size(block.count(0))},
             .first = {place(2, grid.k_begin), place(1, 0), place(0, grid.i_begin)}};
  }

  void centred(const Field& field, const Output& about) {
    if (field.origin == nullptr) return;  // a run without grains has no use for some
    average({.face = field, .out = values_}, about);
  }
  void centred(const Field& field, const FluidField& about) {
    centred(field, outputs_of(field, about)[0]);
  }
  void centred(const FaceVector& faces, const FluidField& about) {
    const auto components = outputs_of(faces, about);
    average({.face = faces.x, .di = 1, .out = values_}, components[0]);
    average({.face = faces.y, .dj = 1, .out = values_}, components[1]);
    average({.face = faces.z, .dk = 1, .out = values_}, components[2]);
  }

 private:
  static std::uint64_t size(int n) { return static_cast<std::uint64_t>(n); }

  void average(AverageToFrame functor, const Output& about) {
    functor.i0 = own_.first[0], functor.j0 = own_.first[1], functor.k0 = own_.first[2];
    if (values_.size() > 0) Kokkos::parallel_for("output: average to centres", cells_, functor);
    const auto host = host_copy(values_);
    write_output(file_, group_, about, std::span<const float>(host.data(), host.size()), extents_,
                 slab_);
  }

  Hdf5File& file_;
  std::string group_;
  CellBlock own_;
  Cells cells_;
  FrameField values_;
  Extents extents_;
  Hyperslab slab_;
};

/// Appends all of the grains, and the shapes of clumps where the file is new.
void append_grains(FrameFile& frames, const GrainFrame& grains, double t, std::int64_t step) {
  const auto preamble = [&](Hdf5File& file) { write_clump_shapes(file, grains.grains); };
  frames.append(t, step, preamble, [&](Hdf5File& file, const std::string& group) {
    file.set_attribute(group, "last_id", last_id(grains.grains));
    write_grain_outputs(file, group, grains);
  });
}

/// Faces and centres of the cells along an axis; `where` says in words which.
void write_axis(Hdf5File& file, const std::string& name, const std::string& where,
                const std::vector<double>& all, int first, int last) {
  const std::vector<double> faces(all.begin() + first, all.begin() + last + 1);
  std::vector<double> centres;
  for (std::size_t i = 1; i < faces.size(); ++i) centres.push_back(0.5 * (faces[i - 1] + faces[i]));
  const auto write = [&](const Output& about, const std::vector<double>& values) {
    write_output(file, "grid", about, std::span(values), {values.size()});
  };
  write({name + "_face", "m", "faces of the cells" + where}, faces);
  write({name, "m", "centres of the cells" + where}, centres);
}

void write_grid(Hdf5File& file, const Grid& grid, const CellBlock& block) {
  std::vector<double> x, y, z;
  for (int i = 0; i <= grid.nx_all; ++i) x.push_back(i * grid.dx);
  for (int k = 0; k <= grid.nz_all; ++k) z.push_back(k * grid.dz);
  const auto y_face = host_copy(grid.y_face_);
  for (int j = 0; j <= grid.ny; ++j) y.push_back(y_face(j + 1));
  write_axis(file, "x", " along the stream", x, block.first[0], block.last[0]);
  write_axis(file, "y", ", upwards", y, block.first[1], block.last[1]);
  write_axis(file, "z", " across the stream", z, block.first[2], block.last[2]);
}

/// The layer of cells that holds the place of a slice; of a place between two the upper one.
CellBlock layer_of(const SliceConfig& slice, const Grid& grid) {
  CellBlock block = all_cells(grid);
  const auto axis = static_cast<std::size_t>(slice.normal);
  int n = 0;
  if (slice.normal == Axis::y) {
    const auto faces = host_copy(grid.y_face_);
    while (n + 1 < grid.ny && faces(n + 2) <= slice.at) ++n;
  } else {
    const double width = slice.normal == Axis::x ? grid.dx : grid.dz;
    n = std::min(static_cast<int>(slice.at / width), block.last[axis] - 1);
  }
  block.first[axis] = n;
  block.last[axis] = n + 1;
  return block;
}

/// Appends a block of the flow, and its grid where the file is new.
void append_flow(FrameFile& frames, const FluidState& fluid, const CellBlock& block, double t,
                 std::int64_t step) {
  const auto preamble = [&](Hdf5File& file) { write_grid(file, fluid.grid, block); };
  frames.append(t, step, preamble, [&](Hdf5File& file, const std::string& group) {
    FieldWriter writer(file, group, fluid.grid, block);
    for_each_fluid_field(fluid, [&](const auto& member, const FluidField& field) {
      if ((field.uses & kInFrame) != 0) writer.centred(member, field);
    });
  });
}

}  // namespace

OutputFiles::OutputFiles(const std::filesystem::path& folder, const Provenance& provenance,
                         std::optional<double> restart_time, MPI_Comm communicator,
                         const PeriodicBox& box, std::span<const SliceConfig> slices)
    : folder_(folder),
      provenance_(provenance),
      communicator_(communicator),
      box_(box),
      fields_(folder / "fields.h5", provenance, restart_time, communicator, fields_xdmf),
      grains_(folder / "grains.h5", provenance, restart_time, communicator, grains_xdmf),
      tracks_(folder / "tracks.h5", provenance, restart_time, communicator) {
  for (const SliceConfig& slice : slices) {
    slices_.emplace(slice.name, FrameFile(folder / ("slice_" + slice.name + ".h5"), provenance,
                                          restart_time, communicator, fields_xdmf));
  }
}

FrameFile OutputFiles::anew(const std::string& name, FrameFile::Describe describe) const {
  return {folder_ / (name + ".h5"), provenance_, {}, communicator_, describe};
}

void OutputFiles::write_fields(const FluidState& fluid, double t, std::int64_t step) {
  append_flow(fields_, fluid, all_cells(fluid.grid), t, step);
}

void OutputFiles::write_slice(const SliceConfig& slice, const FluidState& fluid, double t,
                              std::int64_t step) {
  append_flow(slices_.at(slice.name), fluid, layer_of(slice, fluid.grid), t, step);
}

void OutputFiles::write_average(const Grid& grid, double t, std::int64_t step,
                                std::span<const NamedField> fields,
                                const std::map<std::string, double>& attributes) const {
  const auto preamble = [&](Hdf5File& h5) { write_grid(h5, grid, all_cells(grid)); };
  FrameFile file = anew("flow_average", fields_xdmf);
  file.append(t, step, preamble, [&](Hdf5File& h5, const std::string& group) {
    FieldWriter writer(h5, group, grid, all_cells(grid));
    for (const auto& one : fields) writer.centred(*one.field, one);
    for (const auto& [name, value] : attributes) h5.set_attribute(group, name, value);
  });
}

std::vector<std::string> OutputFiles::write_failure(const FluidState* fluid,
                                                    const GrainState* grains, double t,
                                                    std::int64_t step) const {
  std::vector<std::string> names;
  if (grains != nullptr) {
    FrameFile file = anew("failure_grains", grains_xdmf);
    const ForceArrays contacts{.contact = grains->contact_force};
    append_grains(file, {.grains = *grains, .forces = contacts}, t, step);
    names.emplace_back("failure_grains.xdmf");
  }
  if (fluid != nullptr) {
    FrameFile file = anew("failure_fields", fields_xdmf);
    append_flow(file, *fluid, all_cells(fluid->grid), t, step);
    names.emplace_back("failure_fields.xdmf");
  }
  return names;
}

void OutputFiles::write_tracks(const GrainState& grains, double t, std::int64_t step,
                               const DuneLabels& dunes) {
  tracks_.append(t, step, {}, [&](Hdf5File& file, const std::string& group) {
    write_track_outputs(file, group, {.grains = grains, .box = box_, .dunes = dunes});
  });
}

void OutputFiles::write_grains(const GrainState& grains, double t, std::int64_t step,
                               const ForceArrays& forces, const DuneLabels& dunes) {
  append_grains(grains_, {grains, box_, forces, dunes}, t, step);
}

}  // namespace barchan
