#include "src/app/info_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "src/app/info.hpp"
#include "src/app/info_folder.hpp"
#include "src/base/atomic_file.hpp"
#include "src/base/words.hpp"
#include "src/case/case_values.hpp"
#include "src/case/derived.hpp"
#include "src/case/heaps.hpp"
#include "src/case/load.hpp"
#include "src/initial/grain_table.hpp"
#include "src/run/tables.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

/// First and last line of a table below its header, comments left out.
struct Rows {
  std::string header, first, last;
  std::size_t count = 0;
};

Rows rows_of(const std::string& text) {
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    if (rows.header.empty()) {
      rows.header = line;
      continue;
    }
    if (rows.count++ == 0) rows.first = line;
    rows.last = line;
  }
  return rows;
}

std::string first_cell(const std::string& line) { return line.substr(0, line.find(',')); }

/// Describes one of our tables: its columns with units and meanings; empty if it has another
/// header.
template <class Record>
std::string describe_table(const CsvTable<Record>& table, const Rows& rows) {
  if (rows.header != table.header()) return {};
  std::string text =
      fmt::format("kind     table of a run, as {}\nrows     {}", table.file, rows.count);
  const auto& head = table.columns.front();
  if (rows.count > 0) {
    text += fmt::format(", {} = {} ... {} {}", head.name, first_cell(rows.first),
                        first_cell(rows.last), head.unit);
  }
  text += "\ncolumns:\n";
  for (const Column<Record>& c : table.columns)
    text += fmt::format("  {:<24} {:<7} {}\n", c.name, fmt::format("[{}]", c.unit),
                        without_links(c.meaning));
  return text;
}

std::string describe_grains(const std::string& text, const fs::path& path) {
  const InitialGrains grains = parse_grains_csv(text, path.string());
  if (grains.size() == 0) return "kind     table of grains\ngrains   none\n";
  const auto [least, most] = std::ranges::minmax(grains.diameter);
  return fmt::format(
      "kind     table of grains, for initial.grains\ngrains   {}\ndiameter {:.4g} ... {:.4g} m\n",
      grains.size(), least, most);
}

std::string describe_csv(const fs::path& path) {
  const std::string text = read_text(path);
  const Rows rows = rows_of(text);
  if (rows.header.empty())
    throw std::runtime_error(path.string() + " is empty: no header, no rows");
  std::string told;
  for_each_table([&](const auto& table) {
    if (told.empty()) told = describe_table(table, rows);
  });
  if (!told.empty()) return told;
  const std::string& h = rows.header;
  if (("," + h + ",").find(",diameter,") != h.npos) return describe_grains(text, path);
  return fmt::format("kind     another table\nrows     {}\ncolumns  {}\n", rows.count,
                     printable(h, 1000));
}

/// Drive of a flow, in words.
std::string driven_by(const FluidConfig& fluid) {
  if (fluid.pressure_gradient) return fmt::format("{:g} Pa/m along x", *fluid.pressure_gradient);
  if (fluid.schedule.empty())
    return fmt::format("mean velocity {} m/s", toml_text(fluid.mean_velocity));
  std::string text = "mean velocity by a schedule:";
  for (const FlowTarget& entry : fluid.schedule) {
    text += fmt::format("\n         {:g} s  {} m/s", entry.time, toml_text(entry.velocity));
    if (entry.ramp > 0) text += fmt::format(", reached over {:g} s", entry.ramp);
    if (entry.period > 0)
      text += fmt::format(", and {} m/s sin(2 pi (t - {:g} s) / {:g} s)",
                          toml_text(entry.amplitude), entry.time, entry.period);
  }
  return text;
}

std::string describe_case(const fs::path& path) {
  const std::string text = read_text(path);
  if (("\n" + text).find("\n[study]") != std::string::npos) {
    return fmt::format("kind     study: ./barchan sweep {} --list shows its cases\n",
                       path.string());
  }
  const Case the_case = load_case(path);
  const Config& c = the_case.config;
  std::string told = fmt::format("kind     case\ntitle    {}\nbox      {:g} x {:g} x {:g} m\n",
                                 printable(c.title, 200), c.size[0], c.size[1], c.size[2]);
  if (c.fluid) {
    const auto& [nx, ny, nz] = c.fluid->cells;
    told += fmt::format("flow     {} x {} x {} cells, {}\n", nx, ny, nz, driven_by(*c.fluid));
  }
  if (c.grains) {
    const std::int64_t count = count_of(the_case.sizes);
    told += count > 0 ? fmt::format("grains   {}\n", count) : "grains   those of a file\n";
  }
  for (const HeapConfig& heap :
       c.initial.heaps.empty() ? std::vector<HeapConfig>() : the_case.heaps) {
    told += fmt::format("heap     {}: {} of {} grains\n", printable(heap.name, 60),
                        word_of(heap.shape), count_of(heap.sizes));
  }
  const auto start = [&](const char* name, const fs::path& file) {
    if (file.extension() == ".toml" || file.extension() == ".h5" || file.extension() == ".csv")
      told += fmt::format("start    of the {}: {}\n", name, file.string());
  };
  start("flow", c.initial.fluid);
  start("grains", c.initial.grains);
  told += fmt::format("end      {:g} s, {} fluid steps of {:g} s\n", c.time.end,
                      fluid_steps(c.time), c.time.fluid_step);
  return told +
         fmt::format("Its derived numbers and run time: ./barchan check {}\n", path.string());
}

}  // namespace

std::string describe_path(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return describe_folder(path);
  if (path.filename() == "run.json" || path.filename() == "study.json")
    return describe_folder(path.has_parent_path() ? path.parent_path() : fs::path("."));
  const std::string why = not_a_file(path);
  if (!why.empty()) {
    throw std::runtime_error(fmt::format("cannot read {}: {}{}", path.string(), why,
                                         fs::exists(path, error) ? "" : nearest_file(path)));
  }
  const std::string head = path.string() + "\n";
  if (path.extension() == ".csv") return head + describe_csv(path);
  if (path.extension() == ".toml") return head + describe_case(path);
  if (path.extension() == ".xdmf")
    return head + "kind     description for ParaView of the .h5 file of the same name\n";
  if (path.extension() == ".h5") return describe_file(path);
  throw std::runtime_error(path.string() +
                           ": info knows run and study folders, and files .h5, .csv and .toml");
}

}  // namespace barchan
