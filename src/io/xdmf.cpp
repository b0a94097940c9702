#include "src/io/xdmf.hpp"

#include <fmt/ranges.h>

namespace barchan {

namespace {

/// Reference to an array of the HDF5 file.
std::string data_item(const std::string& h5_name, const std::string& path, const ArrayInfo& info) {
  const bool integers = info.type == ElementType::int32 || info.type == ElementType::int64;
  const bool single = info.type == ElementType::int32 || info.type == ElementType::float32;
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}:/{}"
      "</DataItem>",
      integers ? "Int" : "Float", single ? 4 : 8, fmt::join(info.extents, " "), h5_name, path);
}

/// Extents of an array of the frame; none where it has no such array.
Extents extents_of(const FrameInfo& frame, const std::string& name) {
  const auto array = frame.arrays.find(name);
  return array == frame.arrays.end() ? Extents{} : array->second.extents;
}

/// `shape` gives topology and geometry of a frame, nothing where it is to be left out; every array
/// but that of the points is an attribute at `centre`.
template <class Shape>
std::string time_series(const char* name, const char* centre, const char* points,
                        const std::string& h5_name, const std::vector<FrameInfo>& frames,
                        const Shape& shape) {
  std::string grids;
  for (const auto& frame : frames) {
    std::string content = shape(frame);
    if (content.empty()) continue;
    for (const auto& [array, info] : frame.arrays) {
      if (array == points) continue;
      const char* type = info.extents.size() != 2 ? "Scalar"
                         : info.extents[1] == 3   ? "Vector"
                                                  : "Matrix";
      content += fmt::format(
          "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n          {}\n"
          "        </Attribute>\n",
          array, type, centre, data_item(h5_name, frame.name + "/" + array, info));
    }
    grids += fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.10g}\"/>\n{}"
        "      </Grid>\n",
        frame.name.substr(frame.name.find('/') + 1), frame.t, content);
  }
  return fmt::format(
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n"
      "  </Domain>\n</Xdmf>\n",
      name, grids);
}

}  // namespace

std::string fields_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames) {
  const auto faces = [&](const char* axis, std::uint64_t cells) {
    return data_item(h5_name, fmt::format("grid/{}_face", axis),
                     {.type = ElementType::float64, .extents = {cells + 1}});
  };
  return time_series("fields", "Cell", "", h5_name, frames, [&](const FrameInfo& frame) {
    const Extents n = extents_of(frame, "u");  // nz, ny, nx: XDMF, too, counts the slowest first
    if (n.size() != 3) return std::string();
    return fmt::format(
        "        <Topology TopologyType=\"3DRectMesh\" Dimensions=\"{} {} {}\"/>\n"
        "        <Geometry GeometryType=\"VXVYVZ\">\n          {}\n          {}\n          {}\n"
        "        </Geometry>\n",
        n[0] + 1, n[1] + 1, n[2] + 1, faces("x", n[2]), faces("y", n[1]), faces("z", n[0]));
  });
}

std::string grains_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames) {
  return time_series("grains", "Node", "x", h5_name, frames, [&](const FrameInfo& frame) {
    const Extents n = extents_of(frame, "x");
    if (n.size() != 2 || n[0] == 0) return std::string();
    return fmt::format(
        "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
        "NodesPerElement=\"1\"/>\n"
        "        <Geometry GeometryType=\"XYZ\">\n          {}\n        </Geometry>\n",
        n[0], data_item(h5_name, frame.name + "/x", frame.arrays.at("x")));
  });
}

}  // namespace barchan
