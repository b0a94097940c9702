// Inputs of a case besides its own keys: the content of the files and of the cases that it starts
// from. They tell old results from those that a run would give now.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "src/case/load.hpp"

namespace barchan {

/// Name of the file of a run folder with its inputs, as JSON.
inline constexpr const char* kInputsFile = "config.inputs.json";

/// File that a case starts from; `start`: the case in it, if it is one.
struct CaseInput {
  const char* key;  // "initial.grains"
  std::filesystem::path file;
  std::shared_ptr<const Case> start;
};
std::vector<CaseInput> inputs_of(const Case& the_case);

/// Inputs that a run folder names for its results: for each file its length and CRC-32, for each
/// case its resolved text, as "config", and its own inputs. Null if it names none, as with a case
/// without inputs, or one of earlier versions.
nlohmann::json recorded_inputs(const std::filesystem::path& folder);

/// First input, of the case or of those that it starts from, whose content is not as recorded;
/// empty where nothing is recorded.
std::optional<std::filesystem::path> changed_input(const nlohmann::json& recorded,
                                                   const Case& the_case);

}  // namespace barchan
