// What the results of a case came from besides its own keys: the content of the files it starts
// from, and of the cases. It tells old results from those that a run would give now.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "src/case/load.hpp"

namespace barchan {

/// The name of the file of a run folder that holds it, as JSON.
inline constexpr const char* kInputsFile = "config.inputs.json";

/// A file that a case starts from; `start`: the case in it, if it is one.
struct CaseInput {
  const char* key;  // "initial.grains"
  std::filesystem::path file;
  std::shared_ptr<const Case> start;
};
std::vector<CaseInput> inputs_of(const Case& the_case);

/// What a run folder says that its results came from: of each input that is a file its length and
/// CRC-32, of each that is a case its resolved text, as "config", and its own inputs. Null if it
/// says nothing, as of a case without inputs, or of earlier versions.
nlohmann::json recorded_inputs(const std::filesystem::path& folder);

/// The first input, of the case or of those that it starts from, whose content is not as recorded;
/// none where nothing is recorded.
std::optional<std::filesystem::path> changed_input(const nlohmann::json& recorded,
                                                   const Case& the_case);

}  // namespace barchan
