#include "src/io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace barchan {

namespace {

std::string dimensions(const Extents& extents) {
  std::string text;
  for (const auto extent : extents) {
    if (!text.empty()) text += ' ';
    text += std::to_string(extent);
  }
  return text;
}

/// Reference to an array of the HDF5 file.
std::string data_item(const std::string& h5_name, const std::string& path, const ArrayInfo& info) {
  const bool integers = info.type == ElementType::int32 || info.type == ElementType::int64;
  const bool single = info.type == ElementType::int32 || info.type == ElementType::float32;
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}:/{}"
      "</DataItem>",
      integers ? "Int" : "Float", single ? 4 : 8, dimensions(info.extents), h5_name, path);
}

std::string attribute(const std::string& h5_name, const FrameInfo& frame, const FrameArray& array,
                      const char* centre) {
  const bool vector = array.info.extents.size() == 2 && array.info.extents[1] == 3;
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n          {}\n"
      "        </Attribute>\n",
      array.name, vector ? "Vector" : "Scalar", centre,
      data_item(h5_name, frame.name + "/" + array.name, array.info));
}

std::string time_series(const std::string& name, const std::string& grids) {
  return fmt::format(
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n"
      "  </Domain>\n</Xdmf>\n",
      name, grids);
}

std::string grid(const FrameInfo& frame, const std::string& content) {
  return fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.10g}\"/>\n{}"
      "      </Grid>\n",
      frame.name, frame.t, content);
}

const FrameArray* find(const FrameInfo& frame, const std::string& name) {
  const auto found = std::find_if(frame.arrays.begin(), frame.arrays.end(),
                                  [&name](const FrameArray& array) { return array.name == name; });
  return found == frame.arrays.end() ? nullptr : &*found;
}

std::string face_item(const std::string& h5_name, const char* axis, std::uint64_t cells) {
  return fmt::format("          {}\n",
                     data_item(h5_name, fmt::format("grid/{}_face", axis),
                               {.type = ElementType::float64, .extents = {cells + 1}}));
}

}  // namespace

std::string fields_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames) {
  std::string grids;
  for (const auto& frame : frames) {
    const FrameArray* u = find(frame, "u");
    if (u == nullptr || u->info.extents.size() != 3) continue;
    const auto& cells = u->info.extents;  // nz, ny, nx: XDMF, too, counts the slowest first
    std::string content = fmt::format(
        "        <Topology TopologyType=\"3DRectMesh\" Dimensions=\"{} {} {}\"/>\n"
        "        <Geometry GeometryType=\"VXVYVZ\">\n{}{}{}        </Geometry>\n",
        cells[0] + 1, cells[1] + 1, cells[2] + 1, face_item(h5_name, "x", cells[2]),
        face_item(h5_name, "y", cells[1]), face_item(h5_name, "z", cells[0]));
    for (const auto& array : frame.arrays) content += attribute(h5_name, frame, array, "Cell");
    grids += grid(frame, content);
  }
  return time_series("fields", grids);
}

std::string grains_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames) {
  std::string grids;
  for (const auto& frame : frames) {
    const FrameArray* x = find(frame, "x");
    if (x == nullptr || x->info.extents.size() != 2 || x->info.extents[0] == 0) continue;
    std::string content = fmt::format(
        "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
        "NodesPerElement=\"1\"/>\n"
        "        <Geometry GeometryType=\"XYZ\">\n          {}\n        </Geometry>\n",
        x->info.extents[0], data_item(h5_name, frame.name + "/x", x->info));
    for (const auto& array : frame.arrays) {
      if (array.name != "x") content += attribute(h5_name, frame, array, "Node");
    }
    grids += grid(frame, content);
  }
  return time_series("grains", grids);
}

}  // namespace barchan
