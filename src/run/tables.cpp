#include "src/run/tables.hpp"

#include <nlohmann/json.hpp>

namespace barchan {

std::string columns_text() {
  nlohmann::ordered_json files;
  for_each_table([&](const auto& table) {
    for (const auto& [name, unit, meaning] : table.outputs())
      files[table.file][name] = {{"unit", unit == "-" ? "1" : unit},
                                 {"meaning", without_links(meaning)}};
  });
  return files.dump(1) + "\n";
}

}  // namespace barchan
