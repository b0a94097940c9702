#include "src/run/folder_checks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/base/words.hpp"
#include "src/case/resolved.hpp"
#include "src/io/folder_lock.hpp"
#include "src/io/frame_file.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// Nearest folder on the way up that exists.
fs::path existing_part(const fs::path& folder) {
  fs::path at = fs::absolute(folder).lexically_normal();
  for (;; at = at.parent_path()) {
    std::error_code error;
    const auto status = fs::symlink_status(at, error);
    if (error && status.type() != fs::file_type::not_found && error.value() != ENOTDIR) {
      refuse_folder(folder, error.message());
    }
    if (fs::exists(status) || at == at.parent_path()) return at;
  }
}

bool same_folder(const fs::path& a, const fs::path& b) {
  // Folders that do not exist yet are compared by name, which must not depend on where we are.
  return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

void check_start(const std::string& key, const fs::path& start, const Config& config,
                 const fs::path& folder) {
  const auto lost = [&](const std::string& what) {
    throw InputError(
        fmt::format("{} = {}: {} {}, whose results a new run removes; take another --out", key,
                    start.string(), what, folder.string()));
  };
  if (start.extension() == ".toml") {
    const fs::path results = folder_of_runs(config.file, folder) / case_name(start);
    if (same_folder(results, folder))
      lost("the results of that case go to the folder of this one,");
  } else if (!start.extension().empty() && is_result_name(start.filename()) &&
             same_folder(start.parent_path(), folder)) {
    lost("it is in the run folder");
  }
}

}  // namespace

void check_out_folder(const fs::path& folder) {
  if (folder.empty()) throw InputError("--out: must name a folder, and the name is empty");
  const fs::path there = existing_part(folder);
  std::error_code error;
  if (!fs::is_directory(there, error)) {
    const bool link = fs::is_symlink(there, error);
    refuse_folder(folder, fmt::format("{} is {}", there.string(),
                                      link ? "a link that leads nowhere" : "a file, not a folder"));
  }
  if (::access(there.c_str(), W_OK | X_OK) != 0) {
    refuse_folder(folder,
                  fmt::format("{}: {}", there.string(), std::generic_category().message(errno)));
  }
  if (!same_folder(there, folder)) return;
  for (const auto& entry : fs::directory_iterator(there)) {
    if (is_result_name(entry.path().filename()) && entry.is_directory()) {
      refuse_folder(folder, entry.path().filename().string() + " in it is a folder");
    }
  }
}

void check_nothing_is_lost(const Config& config, const fs::path& folder) {
  if (config.fluid) check_start("initial.fluid", config.initial.fluid, config, folder);
  if (config.grains) check_start("initial.grains", config.initial.grains, config, folder);
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
    check_tables(folder);
    for (const char* name : {"grains.h5", "fields.h5", "tracks.h5"}) {
      if (fs::exists(folder / name)) list_frames(Hdf5File(folder / name, Hdf5File::Mode::read));
    }
  } catch (const std::runtime_error& problem) {
    throw InputError(
        fmt::format("{}; move it away, or go on in another folder with --out", problem.what()));
  }
}

std::string EarlierRun::difference() const {
  if (!same_config) return "of another configuration";
  return changed ? fmt::format("from another content of {}", changed->string()) : "";
}

EarlierRun earlier_run(const Case& the_case, const fs::path& folder) {
  EarlierRun earlier;
  earlier.status = status_in(folder / "run.json");
  earlier.restart = latest_checkpoint(folder);
  earlier.same_config = is_written_in(folder / "config.toml", the_case.config);
  earlier.changed = as_input([&] { return changed_input(recorded_inputs(folder), the_case); });
  return earlier;
}

void check_is_ours(const Config& config, const fs::path& folder) {
  if (!fs::is_directory(folder) || !status_in(folder / "run.json").empty()) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    std::error_code error;
    const bool unfinished = name.extension() == ".tmp";  // all that a kill at the start leaves
    if (is_result_name(name) && !is_checkpoint_name(name) && !unfinished &&
        !fs::equivalent(entry.path(), config.file, error))
      refuse_folder(folder, name.string() + " in it is not of a run");
  }
}

void check_overwrites_nothing(const EarlierRun& earlier, const fs::path& folder) {
  if (!earlier.is_worth_keeping()) return;
  const std::string go_on = earlier.restart ? "go on with --resume, " : "";
  throw InputError(
      fmt::format("{} holds {} run{}{}: {}begin again with --overwrite, or take another --out",
                  folder.string(), earlier.status == "done" ? "a finished" : "an unfinished",
                  earlier.same() ? "" : " ", earlier.difference(), go_on));
}

}  // namespace barchan
