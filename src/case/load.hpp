// Loading of a case: from a TOML file to a Config, or to all that is wrong with it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/errors.hpp"
#include "src/case/settled.hpp"

namespace barchan {

/// Case and the cases that it starts from, read once and handed on.
struct Case : SettledCase {  // without sizes when a .csv or .h5 decides, or there are no grains
  bool random = false;       // its start, or one behind it, draws random numbers: turbulent
                             // flow or poured grains
  std::shared_ptr<const Case> flow_start,
      grain_start;                        // initial.fluid, .grains where they are cases
  std::vector<std::string> notices = {};  // keys of earlier versions, and how to write them today
};

/// Reads the sizes of the grains in a file, .csv or .h5, that a case starts from; throws InputError
/// if it cannot.
using SizesInFile =
    std::function<std::vector<SizeClass>(const Config&, const std::filesystem::path&)>;

/// Reads and validates a case. `overrides`: "key=value" as after --set, applied in order before
/// anything is checked; paths in them too are relative to the folder of the file. A case that this
/// one starts from ([initial], a .toml) is checked along with it, as it stands in its own file.
/// `sizes_in`: without it lengths in diameters and steps that are chosen need grains that are
/// poured. Throws ConfigError.
Case load_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
               const SizesInFile& sizes_in = {});
/// Reads and validates a text, as if it stood in `file` (which need not exist).
Case load_case_text(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {});

/// Reads and validates a case whose starts are of no interest.
Config load_config(const std::filesystem::path& file,
                   const std::vector<std::string>& overrides = {});
Config load_config_text(std::string_view text, const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});

/// Configuration that a result file carries, its keys read as far as they can be: neither checked
/// nor followed to the files it names, which may be gone.
Config config_as_written(std::string_view resolved, const std::filesystem::path& file);

/// Tells if a resolved text says exactly `config`, in whatever words. Keys that it lacks, as one of
/// an earlier version may, count as their defaults.
bool says(std::string_view resolved, const Config& config);
/// Tells if `file`, a config.toml, says exactly `config`.
bool is_written_in(const std::filesystem::path& file, const Config& config);

/// Warnings about a case with grains of these sizes: unwise values, and keys as earlier versions
/// wrote them.
std::vector<std::string> case_warnings(const Case& the_case, const std::vector<SizeClass>& sizes);

}  // namespace barchan
