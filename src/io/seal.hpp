// A checksum over a whole file: a disk, a copy or a cut that changed one bit of it is noticed
// before anything in it is believed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace barchan {

/// Bytes at the start of a file that its own format leaves free (an HDF5 user block) for the seal:
/// a line of text with the length and the CRC-32 (IEEE 802.3) of all that follows them.
inline constexpr std::size_t seal_bytes = 512;

/// True if the file begins as a sealed one, whole or not: only a look at its start. False if it
/// cannot be read.
bool has_seal(const std::filesystem::path& file);

enum class Seal { whole, absent, broken };

/// Writes the seal of a file that is complete but for it. Throws std::runtime_error naming the
/// file.
void seal(const std::filesystem::path& file);

struct SealCheck {
  Seal seal = Seal::absent;
  std::string problem;  // of a broken one, as in "it is cut short: 100 of 200 bytes are left"
};
/// Reads the file once. Throws std::runtime_error if it cannot be read.
SealCheck check_seal(const std::filesystem::path& file);

}  // namespace barchan
