#include "src/run/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

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

constexpr const char* result_names[] = {"config.toml",       "run.json",
                                        "history.csv",       "dune.csv",
                                        "fields.h5",         "fields.xdmf",
                                        "grains.h5",         "grains.xdmf",
                                        "tracks.h5",         "log.txt",
                                        "statistics.csv",    "flow_average.h5",
                                        "flow_average.xdmf", "force_map.csv",
                                        "failure_grains.h5", "failure_grains.xdmf",
                                        "failure_fields.h5", "failure_fields.xdmf"};

/// True for names of files that a new run removes from its folder; pictures and everything that is
/// not ours stay.
bool is_result(const fs::path& name) {
  return std::ranges::count(result_names, name) > 0 || name.extension() == ".tmp" ||
         is_checkpoint_name(name);
}

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

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw InputError(
      fmt::format("cannot write results to {}: {}; take another --out", folder.string(), why));
}

/// The nearest folder on the way up that is there.
fs::path existing_part(const fs::path& folder) {
  fs::path at = fs::absolute(folder).lexically_normal();
  for (;; at = at.parent_path()) {
    std::error_code error;
    const auto status = fs::symlink_status(at, error);
    if (error && status.type() != fs::file_type::not_found && error.value() != ENOTDIR) {
      refuse(folder, error.message());
    }
    if (fs::exists(status) || at == at.parent_path()) return at;
  }
}

bool same_folder(const fs::path& a, const fs::path& b) {
  // What is not there yet is compared by name, which must not depend on where we are.
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

void check_start(const std::string& key, const std::string& source, const fs::path& folder) {
  const fs::path start = source;
  const auto lost = [&](const std::string& what) {
    throw InputError(
        fmt::format("{} = {}: {} {}, whose results a new run removes; take another --out", key,
                    source, what, folder.string()));
  };
  if (start.extension() == ".toml") {
    const fs::path results = fs::absolute(folder).parent_path() / start.stem();
    if (same_folder(results, folder))
      lost("the results of that case go to the folder of this one,");
  } else if (!start.extension().empty() && is_result(start.filename()) &&
             same_folder(start.parent_path(), folder)) {
    lost("it is in the run folder");
  }
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

void check_out_folder(const fs::path& folder) {
  if (folder.empty()) throw InputError("--out: must name a folder, and the name is empty");
  const fs::path there = existing_part(folder);
  std::error_code error;
  if (!fs::is_directory(there, error)) {
    const bool link = fs::is_symlink(there, error);
    refuse(folder, fmt::format("{} is {}", there.string(),
                               link ? "a link that leads nowhere" : "a file, not a folder"));
  }
  if (::access(there.c_str(), W_OK | X_OK) != 0) {
    refuse(folder, fmt::format("{}: {}", there.string(), std::generic_category().message(errno)));
  }
  if (!same_folder(there, folder)) return;
  for (const auto& entry : fs::directory_iterator(there)) {
    if (is_result(entry.path().filename()) && entry.is_directory()) {
      refuse(folder, entry.path().filename().string() + " in it is a folder");
    }
  }
}

void check_nothing_is_lost(const Config& config, const fs::path& folder) {
  if (config.fluid) check_start("initial.fluid", config.initial.fluid, folder);
  if (config.grains) check_start("initial.grains", config.initial.grains, folder);
  const fs::path own = fs::path(folder) / "config.toml";
  std::error_code error;
  if (fs::equivalent(own, config.file, error) && read_text(own) != to_toml(config)) {
    throw InputError(
        fmt::format("{}: the run would write its own config.toml over this case; take another "
                    "--out, or rename it",
                    config.file.string()));
  }
}

void check_results_go_on(const fs::path& folder) {
  try {
    for (const auto& [name, columns] : {history, dune}) text_of_table(folder / name, columns);
    for (const char* name : {"grains.h5", "fields.h5", "tracks.h5"}) {
      if (fs::exists(folder / name)) list_frames(Hdf5File(folder / name, Hdf5File::Mode::read));
    }
  } catch (const std::runtime_error& problem) {
    throw InputError(
        fmt::format("{}; move it away, or go on in another folder with --out", problem.what()));
  }
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
    // Of a run that failed, a restart removes what it left to look at.
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path name = entry.path().filename();
      if (is_result(name) && (!restart_time || name.string().starts_with("failure_"))) {
        fs::remove(entry.path());
      }
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
