// From a TOML file to a Config, or to all that is wrong with it.
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

/// A case and the cases that it starts from, read once and handed on.
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
/// Of a text, as if it stood in `file` (which need not exist).
Case load_case_text(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {});

/// The same where nobody asks for what it starts from.
Config load_config(const std::filesystem::path& file,
                   const std::vector<std::string>& overrides = {});
Config load_config_text(std::string_view text, const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});

/// The configuration that a result file carries, its keys read as far as they can be: neither
/// checked nor followed to the files it names, which may be gone.
Config config_as_written(std::string_view resolved, const std::filesystem::path& file);

/// True if a resolved text says exactly `config`, in whatever words; keys that it lacks, as of an
/// earlier version, count as their defaults.
bool says(std::string_view resolved, const Config& config);
/// The same of `file`, a config.toml.
bool is_written_in(const std::filesystem::path& file, const Config& config);

/// What is unwise in a case with grains of these sizes, and what it writes as earlier versions did.
std::vector<std::string> case_warnings(const Case& the_case, const std::vector<SizeClass>& sizes);

}  // namespace barchan
