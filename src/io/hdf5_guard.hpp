// The HDF5 library believes what a file says of the places of its texts: of a damaged file it reads
// beyond its memory, or in circles. That must not end in a crash or a hang without a word.
#pragma once

#include <filesystem>

namespace barchan::hdf5 {

/// While it lives, a fault of the library or a read of more than `kPatience` seconds ends the
/// program with one line that names the file, and exit code 2. For the reading of a text from a
/// file that may come from anywhere; one at a time.
class Guard {
 public:
  explicit Guard(const std::filesystem::path& file);
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  static constexpr unsigned kPatience = 30;
};

}  // namespace barchan::hdf5
