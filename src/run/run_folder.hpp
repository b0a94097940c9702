// The folder of one run: its configuration, summary and two CSV tables (formats:
// docs/conventions.md).
#pragma once

#include <mpi.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "src/config/config.hpp"
#include "src/diagnostics/dune_shape.hpp"
#include "src/io/hdf5_file.hpp"

namespace barchan {

/// Backend and what it runs on, in words.
std::string device_name();
/// Title and resolved text of the case, version of the program, backend.
Provenance make_provenance(const Config& config);

/// True for names of files that a new run removes from its folder; pictures and everything that is
/// not ours stay.
bool is_result_name(const std::filesystem::path& name);

/// One line of history.csv.
struct HistoryRow {
  double t = 0;  // [s]
  std::int64_t step = 0;
  double u_star = 0;                                          // from the wall shear [m/s]
  double bulk_velocity = 0;                                   // [m/s]
  double pressure_gradient = 0;                               // driving [Pa/m]
  double fluid_kinetic_energy = 0, grain_kinetic_energy = 0;  // [J]
  double cfl = 0;
  double continuity_residual = 0;  // largest of the interval [1/s]
  double pressure_iterations = 0;  // mean of the interval
  std::int64_t n_grains = 0, n_contacts = 0;
  double max_overlap = 0;             // over the mean diameter of the pair
  double grain_flux = 0;              // solid volume per width and time along x [m^2/s]
  double stress_on_grains = 0;        // of the flow along x, mean of the interval [Pa]
  double grain_step_over_stable = 0;  // grain step over the longest for which contacts are stable
};

// The next four throw std::runtime_error naming the file and the reason.

/// A new run (`restart_time` empty): makes the folder, and removes the results and restart files of
/// an earlier run in it, so read what the run starts from before. A run.json is there from the
/// first moment on: it says that the folder is ours.
/// Going on from a restart: keeps them, and cuts the tables after the lines with t <= restart_time.
/// All ranks together; the folder is ready when the call returns it.
std::filesystem::path prepare_folder(const std::filesystem::path& folder,
                                     std::optional<double> restart_time,
                                     MPI_Comm communicator = MPI_COMM_SELF);
/// Adds a whole line to history.csv or dune.csv; on its way to the disk when the call returns.
void append_row(const std::filesystem::path& folder, const HistoryRow& row);
void append_row(const std::filesystem::path& folder, const DuneRow& row);
/// Replaces run.json as a whole. Numbers that are not finite become null.
void write_summary(const std::filesystem::path& folder, const nlohmann::ordered_json& summary);

/// The "status" in a run.json; empty if the file is missing or damaged.
std::string status_in(const std::filesystem::path& run_json);

/// Throws std::runtime_error if history.csv or dune.csv has other columns than a restart goes on
/// with.
void check_tables(const std::filesystem::path& folder);

/// Keeps the lines of a CSV table whose first column is at most `t`; a last line that was not
/// written to its end goes too. A missing or empty file becomes one with the header only.
/// Throws std::runtime_error when the file has another header.
void cut_table(const std::filesystem::path& file, const std::string& header, double t);

}  // namespace barchan
