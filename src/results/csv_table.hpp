// Tables in CSV. Each column is written down once: its name, unit, member and digits.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "src/results/outputs.hpp"

namespace barchan {

/// A column of a table whose lines are Records. Integers are written whole, other numbers with so
/// many significant digits.
template <class Record>
struct Column {
  using Member = std::variant<double Record::*, std::int64_t Record::*>;
  const char* name;
  const char* unit;  // "-": none
  Member member;
  const char* meaning;  // may have links for docs/files.md
  int digits = 9;
};

/// A file, and its columns from left to right. The first is the time where a table grows.
template <class Record>
struct CsvTable {
  const char* file;
  std::span<const Column<Record>> columns;

  std::string header() const {
    std::string text;
    for (const Column<Record>& column : columns) {
      text += text.empty() ? "" : ",";
      text += column.name;
    }
    return text;
  }
  /// A table that grows is cut at a restart.
  bool grows() const { return std::string_view(columns.front().name) == "t"; }
  std::vector<Output> outputs() const {
    std::vector<Output> all;
    for (const Column<Record>& c : columns) all.push_back({c.name, c.unit, c.meaning});
    return all;
  }
  /// Line of a record, with its end.
  std::string line(const Record& record) const {
    std::string text;
    for (const Column<Record>& column : columns) {
      text += text.empty() ? "" : ",";
      text += std::visit([&](auto member) { return number(record.*member, column.digits); },
                         column.member);
    }
    return text + "\n";
  }

 private:
  static std::string number(std::int64_t value, int) { return fmt::format("{}", value); }
  static std::string number(double value, int digits) {
    return fmt::format("{:.{}g}", value, digits);
  }
};

// The next two throw std::runtime_error when the file has another header.

/// The text of a table to go on with; empty if there is none yet.
std::string text_of_table(const std::filesystem::path& file, const std::string& header);

/// Keeps the lines whose first column is at most `t`; a last line that was not written to its end
/// goes too. A missing or empty file becomes one with the header only.
void cut_table(const std::filesystem::path& file, const std::string& header, double t);

}  // namespace barchan
