#include "src/results/grain_outputs.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <variant>

#include "kernels/diagnostics/frame_values.hpp"
#include "src/base/words.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

/// Rows of the file on the host, one for each grain.
template <class T>
using HostRows = Kokkos::View<T**, Kokkos::LayoutRight, Kokkos::HostSpace>;
/// Values of all grains in the type of the file; nothing: the run has no such array.
using GrainValues = std::variant<std::monostate, HostRows<float>, HostRows<double>, HostRows<int>,
                                 HostRows<std::int64_t>>;

/// An array of grains.h5. All ranks get values of the same type, or all get nothing.
struct GrainOutput {
  const char *name, *unit, *meaning;
  GrainValues (*values)(const GrainFrame&);
  GrainValues (*in_tracks)(const GrainFrame&) = nullptr;  // values in tracks.h5; null: not there
  std::vector<std::string> GrainState::*names = nullptr;  // of the values, which count them
};

/// Rows of T with what `value(p)` gives for grain p: a number, a Vec3 or a Quaternion.
template <class T, class Value>
GrainValues rows(const GrainFrame& frame, const Value& value) {
  constexpr int width = std::is_convertible_v<decltype(value(0)), Vec3>         ? 3
                        : std::is_convertible_v<decltype(value(0)), Quaternion> ? 4
                                                                                : 1;
  const auto n = static_cast<std::size_t>(frame.grains.n);
  const FrameRows<T> out("output: rows of grains", n, width);
  Kokkos::parallel_for("output: rows of grains", Kokkos::RangePolicy<>(0, frame.grains.n),
                       StoreRows<T, Value>{value, out});
  return HostRows<T>(host_copy(out));
}

/// Rows of an array, which exists if the run has it.
template <class T, class View>
GrainValues rows_of(const GrainFrame& frame, const View& array) {
  if (array.size() == 0) return {};
  return rows<T>(frame, array);
}

template <auto force>
GrainValues force_of(const GrainFrame& frame) {
  return rows_of<float>(frame, frame.forces.*force);
}

template <auto number>
GrainValues number_of(const GrainFrame& frame) {
  const Kokkos::View<const std::uint8_t*> array = frame.grains.*number;
  if (array.size() == 0) return {};
  return rows<int>(frame, NumberInList{array, kNoHeap});
}

GrainValues ids(const GrainFrame& frame) { return rows_of<std::int64_t>(frame, frame.grains.id); }

GrainValues dunes(const GrainFrame& frame) {
  if (!frame.dunes) return {};
  const HostRows<int> labels("host: dunes", frame.dunes->size(), 1);
  std::ranges::copy(*frame.dunes, labels.data());
  return labels;
}

template <class T>
GrainValues positions(const GrainFrame& frame) {
  return rows<T>(frame, PositionOf<T>{frame.grains.kin, frame.box});
}

template <class T>
GrainValues orientations(const GrainFrame& frame) {
  if (frame.grains.clump.size() == 0) return {};
  return rows<T>(frame, OrientationOf{frame.grains.clump});
}

constexpr const char* kShapes = "spheres";  // group of the spheres of clumps

using F = ForceArrays;

/// The table: one line for each array.
constexpr GrainOutput kGrainOutputs[] = {
    {"id", "1", "number of the grain, the same in all frames", ids, ids},
    {"x", "m", "position of the centre", positions<double>, positions<float>},
    {"d", "m", "diameter",
     [](const GrainFrame& f) { return rows<double>(f, DiameterOf{f.grains.kin}); }},
    {"u", "m/s", "velocity",
     [](const GrainFrame& f) { return rows<float>(f, VelocityOf{f.grains.kin}); }},
    {"omega", "rad/s", "angular velocity",
     [](const GrainFrame& f) { return rows<float>(f, SpinOf{f.grains.kin}); }},
    {"orientation", "1",
     "quaternion w, x, y, z that turns the principal axes of a clump into space; in runs with "
     "clumps",
     orientations<double>, orientations<float>},
    {"force_drag", "N", "drag", force_of<&F::drag>},
    {"force_added_mass", "N", "force of the added mass", force_of<&F::added_mass>},
    {"force_lift", "N", "lift", force_of<&F::lift>},
    {"force_pressure_gradient", "N", "force of the pressure gradient",
     force_of<&F::pressure_gradient>},
    {"force_stress", "N", "force of the viscous and subgrid stress", force_of<&F::stress>},
    {"force_flow", "N", "force of the flow that is resolved around the grain", force_of<&F::flow>},
    {"torque_flow", "N m", "torque of the flow about the centre of the grain",
     force_of<&F::torque>},
    {"force_contact", "N", "sum of the forces in contacts", force_of<&F::contact>},
    {"force_contact_normal", "N", "sum of the normal forces in contacts",
     force_of<&F::contact_normal>},
    {"force_contact_tangential", "N", "sum of the tangential forces in contacts",
     force_of<&F::contact_tangential>},
    {"force_total", "N", "sum of all forces", force_of<&F::total>},
    {"dune", "1", "label of the dune that the grain belongs to, -1: none", dunes, dunes},
    {"kind", "1", "kind of the grain, from 0; \"names\" has a line for each",
     number_of<&GrainState::kind>, nullptr, &GrainState::kind_names},
    {"heap", "1",
     "number of the heap that the grain came from, from 0, -1: of none; \"names\" has a line for "
     "each",
     number_of<&GrainState::heap>, nullptr, &GrainState::heap_names},
};

/// Arrays of the group "spheres", in the order in which they are written.
const Output kShapeOutputs[] = {
    {"kind", "1", "kind of the clumps that have the sphere, from 0"},
    {"centre", "1", "its place in the principal frame of a clump of diameter 1"},
    {"radius", "1", "its radius there"},
};

Output words_of(const GrainOutput& one) { return {one.name, one.unit, one.meaning}; }

/// Writes the rows of this rank among those of all.
template <class T>
void write(Hdf5File& file, const std::string& group, const Output& about, const HostRows<T>& rows,
           const Hyperslab& entries) {
  Extents extents{rows.extent(0)};
  if (rows.extent(1) > 1) extents.push_back(rows.extent(1));
  write_output(file, group, about, std::span<const T>(rows.data(), rows.size()), extents,
               slab_of(entries, extents, 0));
}
void write(Hdf5File&, const std::string&, const Output&, std::monostate, const Hyperslab&) {}

void write_each(Hdf5File& file, const std::string& group, const GrainFrame& frame,
                GrainValues (*GrainOutput::*values)(const GrainFrame&)) {
  const GrainState& grains = frame.grains;
  const Hyperslab entries = slab_of_entries(static_cast<std::uint64_t>(grains.n), grains.ranks);
  for (const GrainOutput& one : kGrainOutputs) {
    if (one.*values == nullptr) continue;
    const GrainValues found = (one.*values)(frame);
    const auto write_rows = [&](const auto& rows) {
      write(file, group, words_of(one), rows, entries);
    };
    std::visit(write_rows, found);
    if (one.names != nullptr && found.index() > 0)
      file.set_attribute(group + "/" + one.name, "names", as_lines(grains.*one.names));
  }
}

}  // namespace

void write_grain_outputs(Hdf5File& file, const std::string& group, const GrainFrame& frame) {
  write_each(file, group, frame, &GrainOutput::values);
}

void write_track_outputs(Hdf5File& file, const std::string& group, const GrainFrame& frame) {
  write_each(file, group, frame, &GrainOutput::in_tracks);
}

void write_clump_shapes(Hdf5File& file, const GrainState& grains) {
  const ClumpShapes& shapes = grains.shapes;
  if (shapes.sphere.size() == 0) return;
  const auto sphere = host_copy(shapes.sphere);
  std::vector<int> kinds;
  std::vector<double> centres, radii;
  for (int kind = 0; kind < kMaxKinds; ++kind) {
    for (int s = shapes.first[kind]; s < shapes.first[kind + 1]; ++s) {
      const Vec3 c = sphere(s).vec();
      kinds.push_back(kind);
      centres.insert(centres.end(), {c.x, c.y, c.z});
      radii.push_back(sphere(s).w());
    }
  }
  const auto write = [&](const Output& about, const auto& values, Extents extents) {
    write_output(file, kShapes, about, std::span(values), extents);
  };
  write(kShapeOutputs[0], kinds, {kinds.size()});
  write(kShapeOutputs[1], centres, {kinds.size(), 3});
  write(kShapeOutputs[2], radii, {kinds.size()});
}

std::vector<Output> clump_shape_outputs() {
  return {std::begin(kShapeOutputs), std::end(kShapeOutputs)};
}

std::vector<Output> grain_outputs() {
  std::vector<Output> all;
  std::ranges::transform(kGrainOutputs, std::back_inserter(all), words_of);
  return all;
}

}  // namespace barchan
