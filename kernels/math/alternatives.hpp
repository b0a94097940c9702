// Alternatives that a case chooses from: types that name themselves, in one list. The word of a
// key, the page of keys, the factory and the loops of the tests follow from the list.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <variant>

namespace barchan {

/// Word for an alternative in a case, and its meaning with its source.
struct Named {
  std::string_view word, meaning;
};

template <class List>
struct Choice;

/// List of types that a case can choose from. Each has a `static constexpr Named named`. One that
/// takes numbers has a `from(given)`.
template <class... Types>
struct Alternatives {
  using Variant = std::variant<Types...>;
  template <template <class> class Of>
  using VariantOf = std::variant<Of<Types>...>;
  static constexpr std::size_t size = sizeof...(Types);
  static constexpr std::array<Named, size> named{Types::named...};
  static constexpr std::array<std::string_view, size> words{Types::named.word...};

  /// The place of a type in the list.
  template <class Type>
  static constexpr std::size_t place_of() {
    constexpr std::array<bool, size> is{std::is_same_v<Type, Types>...};
    static_assert((std::is_same_v<Type, Types> || ...), "not one of these alternatives");
    return static_cast<std::size_t>(std::find(is.begin(), is.end(), true) - is.begin());
  }

  /// Calls f.template operator()<Type>() with each type.
  template <class F>
  static constexpr void each(const F& f) {
    (f.template operator()<Types>(), ...);
  }
  /// Calls f.template operator()<Type>() with the chosen type alone.
  template <class F>
  static constexpr void with(Choice<Alternatives> choice, const F& f) {
    ((choice.template is<Types>() ? f.template operator()<Types>() : void()), ...);
  }

  /// The chosen alternative, made from what is given.
  template <class Given>
  static Variant make(Choice<Alternatives> choice, const Given& given) {
    Variant made;
    with(choice, [&]<class Type>() {
      if constexpr (requires { Type::from(given); }) {
        made = Type::from(given);
      } else {
        static_assert(std::is_empty_v<Type>, "an alternative with numbers has a from(given)");
        made = Type{};
      }
    });
    return made;
  }
};

/// The alternative that a case has chosen: the value of a key.
template <class List>
struct Choice {
  using Of = List;
  std::size_t place = 0;

  template <class Type>
  static constexpr Choice of() {
    return {List::template place_of<Type>()};
  }
  static constexpr std::array<Choice, List::size> all() {
    std::array<Choice, List::size> choices;
    for (std::size_t n = 0; n < List::size; ++n) choices[n] = {n};
    return choices;
  }

  template <class Type>
  constexpr bool is() const {
    return place == List::template place_of<Type>();
  }
  constexpr std::string_view word() const { return List::words[place]; }
  constexpr bool operator==(const Choice&) const = default;
};

}  // namespace barchan
