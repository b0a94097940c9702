// ro-crate-metadata.json: what a run folder holds and how it came about, for archives of data
// (RO-Crate 1.1, https://w3id.org/ro/crate/1.1).
#pragma once

#include <filesystem>
#include <string>

#include "src/io/hdf5_file.hpp"

namespace barchan {

inline constexpr const char* kCrateFile = "ro-crate-metadata.json";

/// One start of the program that wrote to the folder.
struct CrateAction {
  std::string start{};              // as of time_now()
  std::string status{}, message{};  // as in run.json
};

/// The date and time of UTC, ISO 8601.
std::string time_now();

/// Describes the folder as it is now. What the file says of earlier actions stays; those without
/// an end have failed. Throws std::runtime_error naming the file and the reason.
void write_ro_crate(const std::filesystem::path& folder, const Provenance& provenance,
                    const std::string& notes, const CrateAction& action);

}  // namespace barchan
