// A little program that edits an HDF5 file through the library.
#pragma once

#include <filesystem>

#include "tests/fuzz/tape.hpp"

namespace barchan::fuzz {

/// Applies edits until the tape is empty: what the library refuses to do is skipped.
void edit(const std::filesystem::path& file, Tape tape);

}  // namespace barchan::fuzz
