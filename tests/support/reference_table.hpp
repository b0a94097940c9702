// Tables of tests/reference: comment lines with #, one line of column names, then numbers or names.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace barchan::test {

using ReferenceRow = std::map<std::string, std::string>;

inline std::vector<std::string> split_commas(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

inline std::vector<ReferenceRow> table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no table " + path.string());
  std::vector<std::string> columns;
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto cells = split_commas(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    ReferenceRow row;
    for (std::size_t c = 0; c < columns.size(); ++c) row[columns[c]] = cells.at(c);
    rows.push_back(row);
  }
  return rows;
}

inline std::vector<ReferenceRow> reference_table(const std::string& name) {
  return table(std::filesystem::path(BARCHAN_SOURCE_DIR) / "tests/reference" / name);
}

inline double number(const ReferenceRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

}  // namespace barchan::test
