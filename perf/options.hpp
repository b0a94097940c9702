// Options of the suite besides Google Benchmark's own.
#pragma once

#include <filesystem>

namespace barchan {

struct Options {
  bool tiny = false;              // seconds instead of minutes: tests that the suite runs
  std::filesystem::path heaps;    // folder of heap_100k.csv, heap_10k.csv; made there if missing
  std::filesystem::path runs;     // folder of the run folders dune-100k and dune-10k
  std::filesystem::path records;  // a JSON line for each case is added to this file
};

/// The options of this run; main fills them first.
inline Options& options() {
  static Options the_options;
  return the_options;
}

}  // namespace barchan
