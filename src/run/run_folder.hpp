// The folder of one run: configuration, summary and the two CSV tables (formats:
// docs/conventions.md).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "src/diagnostics/dune_shape.hpp"

namespace barchan {

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
  double max_overlap = 0;  // over the mean diameter of the pair
};

/// run.json. Numbers that are not finite become null.
struct RunSummary {
  std::string status = "running";  // "running", "done", "stopped", "failed"
  std::string message;             // why it stopped or failed
  std::string title, version, git_hash, backend, device;
  int threads = 1, ranks = 1;
  std::int64_t steps = 0;  // fluid steps
  double simulated_seconds = 0, wall_seconds = 0;
  std::map<std::string, double> phases;  // wall seconds per fluid step, by phase
  double grain_steps_per_second = 0, cell_steps_per_second = 0;
  double pressure_iterations_mean = 0;
  std::int64_t pressure_iterations_max = 0;
  double max_cfl = 0;
  double max_overlap = 0;                       // over the mean diameter of the pair
  double max_continuity_residual = 0;           // [1/s]
  std::map<std::string, double> ledger;         // mass [kg] and momentum [N s] terms by name
  std::map<std::string, double> communication;  // of rank 0, where there are more; see summary()
  std::int64_t grains_initial = 0, grains_inside = 0, grains_left = 0;
};

/// The text of run.json.
std::string to_json(const RunSummary& summary);
/// The "status" in a run.json; empty if the file is missing or damaged.
std::string status_in(const std::filesystem::path& run_json);

/// Owns the folder's text files. On ranks other than 0 every member does nothing.
/// Every member throws std::runtime_error naming the file and the reason.
class RunFolder {
 public:
  /// A new run (`restart_time` empty): makes the folder, and removes the results and restart files
  /// of an earlier run in it, so read what the run starts from before.
  /// Going on from a restart: keeps them, and cuts the tables after the lines with t <=
  /// restart_time.
  /// All ranks together; it is there when the call returns.
  RunFolder(std::filesystem::path folder, std::optional<double> restart_time,
            MPI_Comm communicator = MPI_COMM_SELF);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  void write_config(const std::string& resolved_toml);
  /// Whole lines, on their way to the disk when the call returns.
  void append(const HistoryRow& row);
  void append(const DuneRow& row);
  void write_summary(const RunSummary& summary);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

 private:
  void append_line(int& descriptor, const char* name, const std::string& line);

  std::filesystem::path folder_;
  bool root_;
  int history_ = -1, dune_ = -1;  // file descriptors; -1: not open
};

/// True for names of files that a new run removes from its folder.
bool is_result(const std::filesystem::path& name);

/// Throws std::runtime_error when a table in the folder is not one that a restart can go on with.
void check_tables(const std::filesystem::path& folder);

/// Keeps the lines of a CSV table whose first column is at most `t`; a last line that was not
/// written to its end goes too. A missing or empty file becomes one with the header only.
/// Throws std::runtime_error when the file has another header.
void cut_table(const std::filesystem::path& file, const std::string& header, double t);

}  // namespace barchan
