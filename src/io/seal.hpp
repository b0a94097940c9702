// A checksum over a whole file: a disk, a copy or a cut that changed one bit of it is noticed
// before anything in it is believed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace barchan {

/// Bytes at the start of a file that its own format leaves free (an HDF5 user block) for the seal:
/// a line of text with the length and the CRC-32 (IEEE 802.3) of all that follows them.
inline constexpr std::size_t kSealBytes = 512;

/// True if the file begins as a sealed one, whole or not: only a look at its start. False if it
/// cannot be read.
bool has_seal(const std::filesystem::path& file);

/// Writes the seal of a file that is complete but for it. Throws std::runtime_error naming the
/// file.
void seal(const std::filesystem::path& file);

/// Reads a file that begins as a sealed one. Empty if all of it is as it was sealed, else what is
/// wrong, as in "it is cut short: 100 bytes, of 200 that were written". Throws std::runtime_error
/// if it cannot be read.
std::string broken_seal(const std::filesystem::path& file);

/// Length and CRC-32 of a file, which tell its content from any other; of a sealed file those in
/// its seal, as of all that was sealed. Throws std::runtime_error if it cannot be read.
std::string content_key(const std::filesystem::path& file);

}  // namespace barchan
