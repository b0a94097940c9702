// Form of a value of a key, for programs; Key::type says it in words.
#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "src/toml/values.hpp"

namespace barchan {

struct Form {
  /// Kinds of forms. any_of: one of the parts; list: any number of the only part; tuple: one of
  /// each part.
  enum class Of { choice, truth, integer, natural, positive, number, text, any_of, list, tuple };
  Of of = Of::text;
  std::size_t count = 0;                     // length of an array; 0: a single value
  std::vector<std::string_view> names = {};  // words to choose from
  std::vector<Form> parts = {};
};

template <class T>
Form form_of() {
  using enum Form::Of;
  if constexpr (requires { ValueKind<T>::form(); }) {
    return ValueKind<T>::form();
  } else if constexpr (HasWords<T>) {
    return {choice, 0, {words_of<T>().begin(), words_of<T>().end()}};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {truth};
  } else if constexpr (std::is_integral_v<T>) {
    return {std::is_unsigned_v<T> ? natural : integer};
  } else if constexpr (std::is_floating_point_v<T>) {
    return {number};
  } else if constexpr (std::is_convertible_v<T, std::string>) {  // a path, too
    return {text};
  } else {
    Form form = form_of<typename T::value_type>();
    form.count = std::tuple_size_v<T>;
    return form;
  }
}

}  // namespace barchan
