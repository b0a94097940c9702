// Folder of one run: its configuration, summary and CSV tables (formats: docs/files.md).
#pragma once

#include <mpi.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "src/case/config.hpp"
#include "src/io/hdf5_file.hpp"

namespace barchan {

struct BodyRecord;
struct DuneRecord;
struct HeapShare;
struct HistoryRecord;
struct ProbeRecord;

/// Backend and the device it runs on, in words.
std::string device_name();
/// Provenance: title and resolved text of the case, version of the program, backend.
Provenance make_provenance(const Config& config);

/// Meaning of a file of this name, in words; empty for files that a run does not write itself.
std::string_view meaning_of(const std::filesystem::path& name);
/// Tells if a new run removes a file of this name from its folder; pictures and everything that is
/// not ours stay.
bool is_result_name(const std::filesystem::path& name);

// The next four throw std::runtime_error naming the file and the reason.

/// Prepares the folder of a run. A new run (`restart_time` empty) makes the folder, and removes the
/// results and restart files of an earlier run in it, so read what the run starts from before. A
/// run.json is there from the first moment on: it says that the folder is ours. A restart keeps
/// them, and cuts the tables after the lines with t <= restart_time. All ranks call it together;
/// the folder is ready when the call returns it.
std::filesystem::path prepare_folder(const std::filesystem::path& folder,
                                     std::optional<double> restart_time,
                                     MPI_Comm communicator = MPI_COMM_SELF);
/// Adds a whole line to history.csv, dune.csv, heaps.csv or bodies.csv, on its way to the disk when
/// the call returns. The last two are made with their first line.
void append_record(const std::filesystem::path& folder, const HistoryRecord& record);
void append_record(const std::filesystem::path& folder, const DuneRecord& record);
void append_record(const std::filesystem::path& folder, const HeapShare& record);
void append_record(const std::filesystem::path& folder, const BodyRecord& record);
/// Adds the lines of a probe to probes.csv, at least one.
void append_records(const std::filesystem::path& folder, std::span<const ProbeRecord> records);
/// Replaces run.json as a whole. Numbers that are not finite become null.
void write_summary(const std::filesystem::path& folder, const nlohmann::ordered_json& summary);

/// Value of "status" in a run.json; empty if the file is missing or damaged.
std::string status_in(const std::filesystem::path& run_json);

/// Throws std::runtime_error if one of these tables has other columns than a restart goes on with.
void check_tables(const std::filesystem::path& folder);

}  // namespace barchan
