// XDMF, the XML beside an HDF5 file by which ParaView and VisIt open it. `h5_name`: a name in the
// same folder.
#pragma once

#include <string>
#include <vector>

#include "src/io/frame_file.hpp"

namespace barchan {

/// Time series on the rectilinear grid of the file; every array of a frame is a cell attribute.
std::string fields_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames);

/// Time series of points; every array but x is a point attribute. Frames without grains are left
/// out: viewers do not take empty arrays.
std::string grains_xdmf(const std::string& h5_name, const std::vector<FrameInfo>& frames);

}  // namespace barchan
