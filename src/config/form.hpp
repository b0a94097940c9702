// What a value of a key looks like, for programs; Key::type says it in words.
#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "src/config/values.hpp"

namespace barchan {

struct Form {
  enum class Of {
    choice,
    truth,
    integer,
    natural,
    number,
    velocity,
    text,
    texts,
    forces,
    sizes,
    other
  };
  Of of = Of::other;
  std::size_t count = 0;                     // of an array; 0: a single value
  std::vector<std::string_view> names = {};  // to choose from
};

template <class T>
Form form_of() {
  using enum Form::Of;
  if constexpr (HasWords<T>) {
    return {choice, 0, {words_of<T>().begin(), words_of<T>().end()}};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {truth};
  } else if constexpr (std::is_integral_v<T>) {
    return {std::is_unsigned_v<T> ? natural : integer};
  } else if constexpr (std::is_floating_point_v<T>) {
    return {number};
  } else if constexpr (std::is_same_v<T, PlaneVelocity>) {
    return {velocity};
  } else if constexpr (std::is_convertible_v<T, std::string>) {  // a path, too
    return {text};
  } else if constexpr (std::is_same_v<T, ForceSwitches>) {
    return {forces};
  } else if constexpr (std::is_same_v<T, std::vector<SizeClass>>) {
    return {sizes};
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    Form form = form_of<typename T::value_type>();
    form.count = std::tuple_size_v<T>;
    return form;
  } else {
    return {};
  }
}

}  // namespace barchan
