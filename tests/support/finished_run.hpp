// Runs that take too long for a test: the folder of a finished one to judge.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace barchan::test {

/// The folder that an environment variable names, seen from the root of the repository; empty
/// when it is not set.
inline std::filesystem::path finished_run(const std::string& variable) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
  const char* folder = std::getenv(variable.c_str());
  if (folder == nullptr || *folder == '\0') return {};
  return std::filesystem::path(BARCHAN_SOURCE_DIR) / folder;
}

}  // namespace barchan::test
