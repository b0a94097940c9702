// Results of tests as tables for the figures of the validation pages, made when BARCHAN_RESULTS
// names a folder:  BARCHAN_RESULTS=docs/validation ./barchan test -R ChungOoi
#pragma once

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "src/run/run_folder.hpp"

namespace barchan::test {

/// Cell of a row: a number or a name.
struct Result {
  std::string column, text;
  template <class Number>
  requires std::is_arithmetic_v<Number> Result(std::string name, Number value)
      : column(std::move(name)), text(fmt::format("{:.9g}", static_cast<double>(value))) {}
  Result(std::string name, std::string value) : column(std::move(name)), text(std::move(value)) {}
};

/// "model name" of Linux's list of processors.
inline std::string processor_name() {
  std::ifstream list("/proc/cpuinfo");
  for (std::string line; std::getline(list, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

/// Origin of a table: the lines above its column names.
inline std::string result_origin() {
  const ::testing::TestInfo& info = *::testing::UnitTest::GetInstance()->current_test_info();
  const bool nightly = std::string(info.name()).find("Nightly") != std::string::npos;
  const std::string tests = nightly ? "-L nightly" : std::string("-R ") + info.test_suite_name();
  return fmt::format(
      "# test: {}.{}\n# command: BARCHAN_RESULTS=docs/validation ./barchan test {}\n"
      "# commit: {}\n# machine: {}; {}\n# date: {:%Y-%m-%d}\n",
      info.test_suite_name(), info.name(), tests, make_provenance({}).git_hash, processor_name(),
      device_name(), fmt::gmtime(std::time(nullptr)));
}

/// Adds a row to DIR/<table>.csv; DIR is $BARCHAN_RESULTS, seen from the root of the repository.
/// The first row that the program adds to a table replaces the old table. Nothing without DIR.
inline void save_result(const std::string& table, const std::vector<Result>& row) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
  const char* folder = std::getenv("BARCHAN_RESULTS");
  if (folder == nullptr || *folder == '\0') return;
  static std::map<std::string, std::ofstream> tables;
  const bool is_new = !tables.contains(table);
  std::ofstream& file = tables[table];
  std::string names, values;
  for (const Result& cell : row) {
    names += (names.empty() ? "" : ",") + cell.column;
    values += (values.empty() ? "" : ",") + cell.text;
  }
  if (is_new) {
    const std::filesystem::path where = std::filesystem::path(BARCHAN_SOURCE_DIR) / folder;
    std::filesystem::create_directories(where);
    file.open(where / (table + ".csv"));
    file << result_origin() << names << '\n';
  }
  file << values << '\n' << std::flush;  // complete also when a later test crashes
  if (!file) throw std::runtime_error("cannot write " + table + ".csv into " + folder);
}

}  // namespace barchan::test
