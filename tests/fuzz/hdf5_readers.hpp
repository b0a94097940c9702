// Everything the program does with an .h5 file that somebody gives it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace barchan::fuzz {

/// A file of this name for the inputs, in memory where the system has such a folder.
std::filesystem::path input_file(const char* name);
void write_input(const std::filesystem::path& file, const void* data, std::size_t size);

/// Lets the library's complaints guide the fuzzer, as the library itself is not instrumented.
void watch_library();

/// Reads the file as grains to start from, as results, as a restart file, and describes it.
void read_as_everything(const std::filesystem::path& file);

/// The arrays and numbers that a restart asks for.
struct StateArray {
  const char* name;
  bool integers;
  int components;  // of one element; 0: one row of numbers
};
constexpr StateArray state_arrays[] = {
    {"grains/id", true, 0},           {"grains/kin", false, 12},
    {"grains/x_reference", false, 3}, {"grains/wall_touching", true, 0},
    {"grains/wall_xi_t", false, 6},   {"grains/of_rank", true, 0},
    {"contacts/first", true, 0},      {"contacts/second", true, 0},
    {"contacts/xi_t", false, 3},      {"dunes", false, 0},
    {"fluid/u_x", false, 0},          {"fluid/p", false, 0}};
constexpr const char* state_numbers[] = {"grains/r_max", "grains/r_min", "fluid/time", "t"};
constexpr const char* state_integers[] = {"step", "grains/n_initial", "grains/n_left"};

}  // namespace barchan::fuzz
