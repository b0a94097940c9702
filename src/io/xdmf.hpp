// XDMF: the XML beside an HDF5 file by which ParaView and VisIt open it.
#pragma once

#include <string>
#include <vector>

#include "src/io/frame_file.hpp"

namespace barchan {

/// Time series on the rectilinear grid of `h5_name` (a name in the same folder); every array of a
/// frame is a cell attribute.
std::string fields_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames);

/// Time series of points; every array but x is a point attribute. Frames without grains are left
/// out: viewers do not take empty arrays.
std::string grains_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames);

}  // namespace barchan
