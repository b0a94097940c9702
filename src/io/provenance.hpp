// Where a file came from: written into every result and restart file.
#pragma once

#include <string>

#include "src/io/hdf5_file.hpp"

namespace barchan {

struct Provenance {
  std::string title{};    // of the case
  std::string config{};   // resolved TOML text
  std::string version{};  // of Barchan
  std::string git_hash{};
  std::string backend{};  // Kokkos backend and device
};

/// As attributes of the file's root. Throws Hdf5Error.
void write_provenance(Hdf5File& file, const Provenance& provenance);
/// What the file says of itself; empty where it says nothing.
Provenance read_provenance(const Hdf5File& file);

}  // namespace barchan
