// Names of an enum's values, as they are written in the source. They are the words of a case.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace barchan {

/// The name of a value; empty if no enumerator has it.
template <auto value>
constexpr std::string_view enumerator() {
#if defined(__clang__) || defined(__GNUC__)
  std::string_view text = __PRETTY_FUNCTION__;  // "... [with auto value = Axis::x; ...]"
#else
#error "the compiler does not say the names of enumerators"
#endif
  text.remove_prefix(text.find("value = ") + 8);
  text = text.substr(0, text.find_first_of(";]"));
  return text.front() == '(' ? std::string_view() : text.substr(text.rfind(':') + 1);
}

/// The names in the order of the values, which count from 0 without a gap.
template <class Enum>
inline constexpr auto kEnumNames = [] {
  constexpr std::size_t most = 16;
  constexpr auto all = []<std::size_t... n>(std::index_sequence<n...>) {
    return std::array{enumerator<static_cast<Enum>(n)>()...};
  }
  (std::make_index_sequence<most>());
  constexpr std::size_t count = [&] {
    std::size_t n = 0;
    while (n < most && !all[n].empty()) ++n;
    return n;
  }();
  static_assert(count > 0 && count < most);
  std::array<std::string_view, count> names;
  for (std::size_t n = 0; n < count; ++n) names[n] = all[n];
  return names;
}();

}  // namespace barchan
