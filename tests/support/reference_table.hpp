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

inline std::filesystem::path reference_file(const std::string& name) {
  return std::filesystem::path(BARCHAN_SOURCE_DIR) / "tests/reference" / name;
}

/// The cells of every line that is no comment; the first are the column names.
inline std::vector<std::vector<std::string>> table_lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no table " + path.string());
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream in(line);
    auto& cells = lines.emplace_back();
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  }
  return lines;
}

inline std::vector<ReferenceRow> table(const std::filesystem::path& path) {
  const auto lines = table_lines(path);
  std::vector<ReferenceRow> rows;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    ReferenceRow& row = rows.emplace_back();
    for (std::size_t c = 0; c < lines[0].size(); ++c) row[lines[0][c]] = lines[n].at(c);
  }
  return rows;
}

inline std::vector<ReferenceRow> reference_table(const std::string& name) {
  return table(reference_file(name));
}

inline double number(const ReferenceRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

/// A column at x, linear between the rows, in which the column `of` grows.
inline double linear(const std::vector<ReferenceRow>& rows, const std::string& of,
                     const std::string& column, double x) {
  std::size_t n = 1;
  while (n + 1 < rows.size() && number(rows[n], of) < x) ++n;
  const double x0 = number(rows[n - 1], of), x1 = number(rows[n], of);
  const double f0 = number(rows[n - 1], column), f1 = number(rows[n], column);
  return f0 + (f1 - f0) * (x - x0) / (x1 - x0);
}

}  // namespace barchan::test
