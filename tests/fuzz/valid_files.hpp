// Small files as the program writes them, for edits to start from.
#pragma once

#include <filesystem>

namespace barchan::fuzz {

/// A restart file of three grains in a small flow, named restart_0000000007.h5 in the folder.
std::filesystem::path write_restart(const std::filesystem::path& folder);
/// A grains.h5 of two frames.
std::filesystem::path write_frames(const std::filesystem::path& folder);

}  // namespace barchan::fuzz
