#include "src/run/run_folder.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "barchan_version.hpp"
#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/bodies/body_surface.hpp"
#include "src/case/resolved.hpp"
#include "src/io/frame_file.hpp"
#include "src/parallel/communicator.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/ro_crate.hpp"
#include "src/run/tables.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// File of a run folder, and its meaning.
struct ResultFile {
  const char *name, *meaning;
};
constexpr ResultFile kResultFiles[] = {
    {"config.toml", "the case with all defaults"},
    {kColumnsFile, "units and meanings of the columns of the tables"},
    {kInputsFile, "length and CRC-32 of the files that the case starts from"},
    {"run.json", "summary: status, wall time, extremes, momentum budget"},
    {kCrateFile, "this description of the folder, RO-Crate"},
    {"log.txt", "log with all details"},
    {kHistoryTable.file, "flow and grains against time"},
    {kDuneTable.file, "size, place and horns of each dune against time"},
    {kHeapTable.file, "grains of each heap in each dune against time"},
    {kBodyTable.file, "forces and torques on the bodies against time"},
    {kProbeTable.file, "flow at the probes against time"},
    {kBodiesFile, "surfaces of the bodies"},
    {"encounters.csv", "how dunes met each other"},
    {"statistics.csv", "averages of the flow over planes and time"},
    {"flow_average.h5", "averages of the flow over time in every cell"},
    {"flow_average.xdmf", "description of flow_average.h5 for ParaView"},
    {"force_map.csv", "mean force on the grains about the dune"},
    {"bedload.csv", "grains in layers, surface of the bed, stress and load there"},
    {"fields.h5", "frames of the flow in every cell"},
    {"fields.xdmf", "description of fields.h5 for ParaView"},
    {"grains.h5", "frames of all grains"},
    {"grains.xdmf", "description of grains.h5 for ParaView"},
    {"tracks.h5", "frames of the positions of all grains"},
    {"failure_grains.h5", "grains of the faulty state that stopped the run"},
    {"failure_grains.xdmf", "description of failure_grains.h5 for ParaView"},
    {"failure_fields.h5", "flow of the faulty state that stopped the run"},
    {"failure_fields.xdmf", "description of failure_fields.h5 for ParaView"}};

/// Appends to a table that not every run has; its first line begins it.
template <class Record>
void append_or_begin(const fs::path& folder, const CsvTable<Record>& table,
                     std::span<const Record> records) {
  const fs::path file = folder / table.file;
  if (!fs::exists(file)) cut_table(file, table.header(), records.front().t);
  std::string lines;
  for (const Record& record : records) lines += table.line(record);
  append_text(file, lines);
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

std::string_view meaning_of(const fs::path& name) {
  if (is_checkpoint_name(name)) return "complete state, from which the run can go on";
  if (name.string().starts_with("slice_")) {
    if (name.extension() == ".h5") return "frames of the flow in a layer of cells";
    if (name.extension() == ".xdmf") return "description of a slice for ParaView";
  }
  const auto* const file = std::ranges::find(kResultFiles, name, &ResultFile::name);
  return file != std::end(kResultFiles) ? file->meaning : "";
}

bool is_result_name(const fs::path& name) {
  return !meaning_of(name.extension() == ".tmp" ? name.stem() : name).empty();
}

void check_tables(const fs::path& folder) {
  for_each_table([&](const auto& table) {
    if (table.grows()) text_of_table(folder / table.file, table.header());
  });
}

std::string status_in(const fs::path& run_json) {
  std::ifstream in(run_json);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto status = json.find("status");
  return status != json.end() && status->is_string() ? status->get<std::string>() : std::string();
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
    // A restart of a run that failed removes the files that show why.
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path name = entry.path().filename();
      const bool goes = !restart_time || name.string().starts_with("failure_");
      if (goes && is_result_name(name) && name != "run.json") fs::remove(entry.path());
    }
    const double t = restart_time.value_or(0);
    cut_table(folder / kHistoryTable.file, kHistoryTable.header(), t);
    cut_table(folder / kDuneTable.file, kDuneTable.header(), t);
    for_each_table([&](const auto& table) {
      const fs::path file = folder / table.file;
      if (table.grows() && fs::exists(file)) cut_table(file, table.header(), t);
    });
    write_atomically(folder / kColumnsFile, columns_text());
  }
  synchronise(communicator);
  return folder;
}

void append_record(const fs::path& folder, const HistoryRecord& record) {
  append_text(folder / kHistoryTable.file, kHistoryTable.line(record));
}

void append_record(const fs::path& folder, const DuneRecord& record) {
  append_text(folder / kDuneTable.file, kDuneTable.line(record));
}

void append_record(const fs::path& folder, const HeapShare& record) {
  append_or_begin(folder, kHeapTable, std::span(&record, 1));
}

void append_record(const fs::path& folder, const BodyRecord& record) {
  append_or_begin(folder, kBodyTable, std::span(&record, 1));
}

void append_records(const fs::path& folder, std::span<const ProbeRecord> records) {
  append_or_begin(folder, kProbeTable, records);
}

void write_summary(const fs::path& folder, const nlohmann::ordered_json& summary) {
  // Texts that are not UTF-8 (a path in the message) must not cost the summary.
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_atomically(folder / "run.json", summary.dump(2, ' ', false, replace) + "\n");
}

}  // namespace barchan
