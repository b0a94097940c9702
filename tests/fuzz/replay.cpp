// Replay without libFuzzer: gives a target every file named, and every file in the folders named.
// --random SECONDS [SEED] after them goes on with bytes by chance, for targets that make sense of
// any.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "src/base/atomic_file.hpp"
#include "tests/fuzz/fuzzed.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::vector<fs::path>& places) {
  std::vector<fs::path> files;
  for (const auto& place : places) {
    if (fs::is_directory(place)) {
      for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
    } else {
      files.push_back(place);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void give(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// The input on its way is in the file "input.random": it is what a crash is about.
void go_on_by_chance(double seconds, unsigned seed) {
  std::mt19937 engine(seed);
  const auto begin = std::chrono::steady_clock::now();
  int n = 0;
  while (std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(seconds)) {
    const auto most = 4u << (engine() % 5);  // often few, or nothing is left whole
    std::string bytes(1 + engine() % most, '\0');
    for (char& byte : bytes) byte = static_cast<char>(engine());
    std::ofstream("input.random", std::ios::binary) << bytes;
    give(bytes);
    ++n;
  }
  fs::remove("input.random");
  std::cout << n << " inputs by chance\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (LLVMFuzzerInitialize != nullptr) LLVMFuzzerInitialize(&argc, &argv);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const auto option = std::find(words.begin(), words.end(), "--random");
  const auto files = files_of({words.begin(), option});
  for (const auto& file : files) {
    // Print at once: the last file named is the one that fails.
    std::cout << file.string() << '\n' << std::flush;
    give(barchan::read_text(file));
  }
  std::cout << files.size() << " inputs, every one read or refused with a sentence\n";
  const auto n_left = words.end() - option;
  if (n_left > 1)
    go_on_by_chance(std::stod(option[1]),
                    n_left > 2 ? static_cast<unsigned>(std::stoul(option[2])) : 1U);
  return 0;
}
