// HDF5 files for the fuzzers: small ones as the program writes them, edits of those, and everything
// the program does with an .h5 file that somebody gives it.
#pragma once

#include <filesystem>

#include "tests/fuzz/fuzzed.hpp"

namespace barchan::fuzz {

/// A file of this name in the folder of this process's inputs.
std::filesystem::path input_file(const char* name);
void write_input(const std::filesystem::path& file, const void* data, std::size_t size);

/// A restart file of three grains in a small flow, named restart_0000000007.h5 in the folder.
std::filesystem::path write_restart(const std::filesystem::path& folder);
/// A grains.h5 of two frames.
std::filesystem::path write_frames(const std::filesystem::path& folder);

/// Applies edits until the tape is empty: what the library refuses to do is skipped.
void edit(const std::filesystem::path& file, Tape tape);

/// Reads the file as grains to start from, as results, as a restart file, and describes it.
void read_as_everything(const std::filesystem::path& file);

}  // namespace barchan::fuzz
