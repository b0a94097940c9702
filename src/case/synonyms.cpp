#include "src/case/synonyms.hpp"

#include "src/toml/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace barchan {
namespace {

/// Tells if `name` is one of the words of `list`.
bool holds(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (list.substr(0, end) == name) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

struct Removed {
  std::string_view key, value, why;  // no value: the key as a whole
};
constexpr Removed kRemoved[] = {
    {"coupling.relaxation", "", "the exchange needs none any more; delete this line"},
    {"solver.correctors", "", "one correction of the pressure a step is exact; delete this line"},
    {"solver.preconditioner", "\"jacobi\"", "take \"local_fft\", the default, or \"fft\""},
    {"solver.preconditioner", "\"none\"", "take \"local_fft\", the default, or \"fft\""}};

}  // namespace

std::string_view keys_meant_by(std::string_view word, std::string_view section) {
  for (const Synonym& one : kSynonyms) {
    if (one.word == word && (one.sections.empty() || holds(one.sections, section))) return one.keys;
  }
  return {};
}

std::string removal(std::string_view dotted, std::string_view value) {
  for (const Removed& one : kRemoved) {
    if (one.key != dotted || one.value != value) continue;
    return fmt::format("was removed after version 0.1.0: {}", one.why);
  }
  return {};
}

}  // namespace barchan
