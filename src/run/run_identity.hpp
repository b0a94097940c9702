// What a run writes about itself into its files.
#pragma once

#include <string>

#include "src/config/config.hpp"
#include "src/io/hdf5_file.hpp"

namespace barchan {

/// Title and resolved text of the case, version of the program, backend.
Provenance make_provenance(const Config& config);

/// Backend and what it runs on, in words.
std::string device_name();

}  // namespace barchan
