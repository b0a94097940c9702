#include "src/run/run_folder.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "barchan_version.hpp"
#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/config/resolved.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/frame_file.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

struct Table {
  const char *name, *columns;
};
constexpr Table history{
    "history.csv",
    "t,step,u_star,bulk_velocity,pressure_gradient,fluid_kinetic_energy,grain_kinetic_energy,cfl,"
    "continuity_residual,pressure_iterations,n_grains,n_contacts,max_overlap,grain_flux,"
    "stress_on_grains,grain_step_over_stable"};
constexpr Table dune{
    "dune.csv",
    "t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost,flux,"
    "horn_left_2d,horn_right_2d"};

constexpr const char* kResultNames[] = {"config.toml",       "run.json",
                                        "history.csv",       "dune.csv",
                                        "fields.h5",         "fields.xdmf",
                                        "grains.h5",         "grains.xdmf",
                                        "tracks.h5",         "log.txt",
                                        "statistics.csv",    "flow_average.h5",
                                        "flow_average.xdmf", "force_map.csv",
                                        "failure_grains.h5", "failure_grains.xdmf",
                                        "failure_fields.h5", "failure_fields.xdmf"};

/// The text of a table to go on with; empty if there is none yet.
std::string text_of_table(const fs::path& file, const std::string& header) {
  const std::string first_line = header + "\n";
  const std::string text = fs::exists(file) ? read_text(file) : std::string();
  if (!text.empty() && !text.starts_with(first_line) && !first_line.starts_with(text)) {
    throw std::runtime_error("cannot continue " + file.string() + ": its columns are not \"" +
                             header + "\"");
  }
  return text;
}

}  // namespace

std::string device_name() {
  return std::string(Kokkos::DefaultExecutionSpace::name()) + ", " +
         std::to_string(Kokkos::DefaultExecutionSpace().concurrency()) + " threads";
}

Provenance make_provenance(const Config& config) {
  return {.title = config.title,
          .config = to_toml(config),
          .version = BARCHAN_VERSION,
          .git_hash = BARCHAN_GIT_HASH,
          .backend = device_name()};
}

bool is_result_name(const fs::path& name) {
  const auto known = [](const fs::path& file) {
    return std::ranges::count(kResultNames, file) > 0 || is_checkpoint_name(file);
  };
  return known(name) || (name.extension() == ".tmp" && known(name.stem()));
}

void check_tables(const fs::path& folder) {
  for (const auto& [name, columns] : {history, dune}) text_of_table(folder / name, columns);
}

std::string status_in(const fs::path& run_json) {
  std::ifstream in(run_json);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto status = json.find("status");
  return status != json.end() && status->is_string() ? status->get<std::string>() : std::string();
}

void cut_table(const fs::path& file, const std::string& header, double t) {
  std::istringstream lines(text_of_table(file, header));
  std::string kept = header + "\n", line;
  std::getline(lines, line);
  const auto columns = std::count(header.begin(), header.end(), ',');
  const double last = t + 1e-9 * std::max(1.0, std::abs(t));  // times have ten digits in the table
  while (std::getline(lines, line) && !lines.eof()) {         // at the end: not written to its own
    double line_time = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), line_time);
    const bool whole = std::count(line.begin(), line.end(), ',') == columns;
    if (whole && error == std::errc() && *stop == ',' && line_time <= last) kept += line + "\n";
  }
  write_atomically(file, kept);
}

fs::path prepare_folder(const fs::path& folder, std::optional<double> restart_time,
                        MPI_Comm communicator) {
  synchronise(communicator);  // others may still read what is about to go
  if (rank_of(communicator) == 0) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      throw InputError(fmt::format("cannot make the folder {}: {}; take another --out",
                                   folder.string(), error.message()));
    }
    if (!restart_time || status_in(folder / "run.json").empty())
      write_summary(folder, {{"status", "running"}, {"message", ""}});
    // Of a run that failed, a restart removes what it left to look at.
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path name = entry.path().filename();
      const bool goes = !restart_time || name.string().starts_with("failure_");
      if (goes && is_result_name(name) && name != "run.json") fs::remove(entry.path());
    }
    for (const auto& [name, columns] : {history, dune})
      cut_table(folder / name, columns, restart_time.value_or(0));
  }
  synchronise(communicator);
  return folder;
}

void append_row(const fs::path& folder, const HistoryRow& r) {
  append_text(
      folder / history.name,
      fmt::format("{:.10g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.4g},{},{},"
                  "{:.6g},{:.9g},{:.9g},{:.4g}\n",
                  r.t, r.step, r.u_star, r.bulk_velocity, r.pressure_gradient,
                  r.fluid_kinetic_energy, r.grain_kinetic_energy, r.cfl, r.continuity_residual,
                  r.pressure_iterations, r.n_grains, r.n_contacts, r.max_overlap, r.grain_flux,
                  r.stress_on_grains, r.grain_step_over_stable));
}

void append_row(const fs::path& folder, const DuneRow& r) {
  append_text(folder / dune.name,
              fmt::format("{:.10g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},"
                          "{:.9g},{:.9g},{:.9g},{},{:.9g},{:.9g},{:.9g}\n",
                          r.t, r.dune, r.n_grains, r.w, r.l, r.h, r.cx, r.cy, r.cz, r.horn_left,
                          r.horn_right, r.crest_x, r.volume, r.celerity, r.n_lost, r.flux,
                          r.horn_left_2d, r.horn_right_2d));
}

void write_summary(const fs::path& folder, const nlohmann::ordered_json& summary) {
  // Texts that are not UTF-8 (a path in the message) must not cost the summary.
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_atomically(folder / "run.json", summary.dump(2, ' ', false, replace) + "\n");
}

}  // namespace barchan
