#include "src/results/outputs.hpp"

#include <fmt/format.h>

namespace barchan {

std::string page_of(std::span<const Output> outputs, const std::string& heading) {
  std::string text = fmt::format("| {} | unit | meaning |\n|---|---|---|\n", heading);
  for (const auto& [name, unit, meaning] : outputs)
    text += fmt::format("| `{}` | {} | {} |\n", name, unit, meaning);
  return text;
}

std::string without_links(std::string text) {
  for (std::size_t open; (open = text.find("](")) != text.npos;) {
    text.erase(open, text.find(')', open) - open + 1);
    text.erase(text.rfind('[', open), 1);
  }
  return text;
}

}  // namespace barchan
