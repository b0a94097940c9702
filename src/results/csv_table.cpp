#include "src/results/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "src/base/atomic_file.hpp"
#include "src/base/same_time.hpp"

namespace barchan {

namespace fs = std::filesystem;

std::string text_of_table(const fs::path& file, const std::string& header) {
  const std::string first_line = header + "\n";
  const std::string text = fs::exists(file) ? read_text(file) : std::string();
  if (!text.empty() && !text.starts_with(first_line) && !first_line.starts_with(text)) {
    throw std::runtime_error("cannot continue " + file.string() + ": its columns are not \"" +
                             header + "\"");
  }
  return text;
}

void cut_table(const fs::path& file, const std::string& header, double t) {
  std::istringstream lines(text_of_table(file, header));
  std::string kept = header + "\n", line;
  std::getline(lines, line);
  const auto columns = std::count(header.begin(), header.end(), ',');
  const double last = last_same_time(t);
  while (std::getline(lines, line) && !lines.eof()) {  // at the end: not written to its own
    double line_time = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), line_time);
    const bool whole = std::count(line.begin(), line.end(), ',') == columns;
    if (whole && error == std::errc() && *stop == ',' && line_time <= last) kept += line + "\n";
  }
  write_atomically(file, kept);
}

}  // namespace barchan
