// File ro-crate-metadata.json: content and origin of a run folder, for archives of data (RO-Crate
// 1.1, https://w3id.org/ro/crate/1.1).
#pragma once

#include <filesystem>
#include <string>

#include "src/io/hdf5_file.hpp"

namespace barchan {

inline constexpr const char* kCrateFile = "ro-crate-metadata.json";

/// Start of the program that wrote to the folder.
struct CrateAction {
  std::string start{};              // as of time_now()
  std::string status{}, message{};  // as in run.json
};

/// Date and time in UTC, ISO 8601.
std::string time_now();

/// Describes the folder as it is now. Earlier actions in the file stay; those without an end have
/// failed. Throws std::runtime_error naming the file and the reason.
void write_ro_crate(const std::filesystem::path& folder, const Provenance& provenance,
                    const std::string& notes, const CrateAction& action);

}  // namespace barchan
