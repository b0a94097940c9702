#include "src/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <system_error>

#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/io/checkpoint.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

constexpr const char* history_name = "history.csv";
constexpr const char* dune_name = "dune.csv";
constexpr const char* history_header =
    "t,step,u_star,bulk_velocity,pressure_gradient,fluid_kinetic_energy,grain_kinetic_energy,cfl,"
    "continuity_residual,pressure_iterations,n_grains,n_contacts,max_overlap";
constexpr const char* dune_header =
    "t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost,flux";

/// Of a run that failed: a restart removes them too.
constexpr const char* failure_names[] = {"failure_grains.h5", "failure_grains.xdmf",
                                         "failure_fields.h5", "failure_fields.xdmf"};
constexpr const char* result_names[] = {
    "config.toml",     "run.json",          "history.csv",   "dune.csv",  "fields.h5",
    "fields.xdmf",     "grains.h5",         "grains.xdmf",   "tracks.h5", "statistics.csv",
    "flow_average.h5", "flow_average.xdmf", "force_map.csv", "log.txt"};

/// Results of an earlier run; pictures and everything that is not ours stay.
void remove_results(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_result(entry.path().filename())) std::filesystem::remove(entry.path());
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError("cannot make the folder " + folder.string() + ": " + error.message() +
                     "; take another --out");
  }
}

bool is_one_of(std::span<const char* const> names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The text of a table to go on with; empty if there is none yet.
std::string text_of_table(const std::filesystem::path& file, const std::string& header) {
  const std::string first_line = header + "\n";
  const std::string text = std::filesystem::exists(file) ? read_text(file) : std::string();
  if (!text.empty() && !text.starts_with(first_line) && !first_line.starts_with(text)) {
    throw std::runtime_error("cannot continue " + file.string() + ": its columns are not \"" +
                             header + "\"");
  }
  return text;
}

}  // namespace

bool is_result(const std::filesystem::path& name) {
  return is_one_of(result_names, name) || is_one_of(failure_names, name) ||
         name.extension() == ".tmp" || is_checkpoint_name(name);
}

std::string status_in(const std::filesystem::path& run_json) {
  std::ifstream in(run_json);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto status = json.find("status");
  return status != json.end() && status->is_string() ? status->get<std::string>() : std::string();
}

void check_tables(const std::filesystem::path& folder) {
  text_of_table(folder / history_name, history_header);
  text_of_table(folder / dune_name, dune_header);
}

void cut_table(const std::filesystem::path& file, const std::string& header, double t) {
  std::string kept = header + "\n";
  const std::string text = text_of_table(file, header);
  const auto columns = std::count(header.begin(), header.end(), ',');
  const double last = t + 1e-9 * std::max(1.0, std::abs(t));  // times have ten digits in the table
  for (std::size_t begin = kept.size(), end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    if (end == std::string::npos) break;  // not written to its end
    const std::string_view line(text.data() + begin, end - begin);
    double line_time = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), line_time);
    const bool whole = std::count(line.begin(), line.end(), ',') == columns;
    if (whole && error == std::errc() && *stop == ',' && line_time <= last) {
      kept.append(line).push_back('\n');
    }
  }
  write_atomically(file, kept);
}

RunFolder::RunFolder(std::filesystem::path folder, std::optional<double> restart_time,
                     MPI_Comm communicator)
    : folder_(std::move(folder)), root_(rank_of(communicator) == 0) {
  synchronise(communicator);  // others may still read what is about to go
  if (root_) {
    make_folder(folder_);
    for (const char* name : failure_names) std::filesystem::remove(folder_ / name);
    if (!restart_time) remove_results(folder_);
    const double t = restart_time.value_or(0.0);
    cut_table(file(history_name), history_header, t);
    cut_table(file(dune_name), dune_header, t);
  }
  synchronise(communicator);
}

RunFolder::~RunFolder() {
  for (const int descriptor : {history_, dune_}) {
    if (descriptor >= 0) ::close(descriptor);
  }
}

void RunFolder::write_config(const std::string& resolved_toml) {
  if (root_) write_atomically(file("config.toml"), resolved_toml);
}

void RunFolder::append_line(int& descriptor, const char* name, const std::string& line) {
  if (!root_) return;
  if (descriptor < 0) descriptor = ::open(file(name).c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) cannot("write", file(name));
  write_all(descriptor, line, file(name));
}

void RunFolder::append(const HistoryRow& r) {
  append_line(
      history_, history_name,
      fmt::format("{:.10g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.4g},{},{},"
                  "{:.6g}\n",
                  r.t, r.step, r.u_star, r.bulk_velocity, r.pressure_gradient,
                  r.fluid_kinetic_energy, r.grain_kinetic_energy, r.cfl, r.continuity_residual,
                  r.pressure_iterations, r.n_grains, r.n_contacts, r.max_overlap));
}

void RunFolder::append(const DuneRow& r) {
  append_line(dune_, dune_name,
              fmt::format("{:.10g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},"
                          "{:.9g},{:.9g},{:.9g},{},{:.9g}\n",
                          r.t, r.dune, r.n_grains, r.w, r.l, r.h, r.cx, r.cy, r.cz, r.horn_left,
                          r.horn_right, r.crest_x, r.volume, r.celerity, r.n_lost, r.flux));
}

void RunFolder::write_summary(const nlohmann::ordered_json& summary) {
  if (!root_) return;
  // Texts that are not UTF-8 (a path in the message) must not cost the summary.
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_atomically(file("run.json"), summary.dump(2, ' ', false, replace) + "\n");
}

}  // namespace barchan
