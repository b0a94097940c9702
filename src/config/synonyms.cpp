#include "src/config/synonyms.hpp"

#include <algorithm>

namespace barchan {
namespace {

/// Is `name` one of the words of `list`?
bool holds(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (list.substr(0, end) == name) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

}  // namespace

std::string_view keys_meant_by(std::string_view word, std::string_view section) {
  for (const Synonym& one : kSynonyms) {
    if (one.word == word && (one.sections.empty() || holds(one.sections, section))) return one.keys;
  }
  return {};
}

}  // namespace barchan
