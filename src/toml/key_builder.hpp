// Builder for the table of keys.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "src/toml/keys.hpp"

namespace barchan {

enum Rule { none = 0, required = 1, fixed_by_restart = 2, required_and_fixed = 3 };

/// Adds a section.
inline Section& add(Sections& all, const char* name, const char* meaning) {
  return all.emplace_back(Section{.name = name, .meaning = meaning});
}

/// Object that `parent` points to, or holds; nullptr if it is absent.
template <class T>
auto* value_of(T* parent) {
  if constexpr (requires { parent->has_value(); }) {
    return parent != nullptr && *parent ? &**parent : nullptr;
  } else {
    return parent;
  }
}

/// Struct with the members, in a Config; for a section that may be written many times, that of its
/// nth entry.
template <class Get, class C>
auto* parent_of(const Get& get, C& config, std::size_t entry) {
  if constexpr (requires { get(config, entry); }) {
    return get(config, entry);
  } else {
    return value_of(get(config));
  }
}

/// Builder of a section: adds keys, one a call. `Get`: from a Config to a pointer to the struct
/// with the members, nullptr where that is absent, or to the std::optional of it: then the section
/// is there when the file has it.
template <class Get>
class Keys {
 public:
  Keys(Section& section, Get get) : section_(section), get_(get) {
    if constexpr (requires { get(std::declval<Config&>())->emplace(); }) {
      section.prepare = [get](Config& c, bool in_file) {
        if (auto* parent = get(c); in_file && parent != nullptr) parent->emplace();
      };
    }
  }

  template <class Struct, class T>
  Key& operator()(const char* name, T Struct::*member, const char* meaning, Rule rule = none) {
    return (*this)(name, member, any, "", meaning, rule);
  }

  template <class Struct, class T>
  Key& operator()(const char* name, T Struct::*member, const Range& range, const char* unit,
                  const char* meaning, Rule rule = none) {
    if ((rule & required) != 0 && !section_.prepare && !section_.repeated())
      section_.required = true;
    section_.keys.push_back(
        Key{.section = section_.name,
            .name = name,
            .type = type_text<Plain<T>>(),
            .form = form_of<Plain<T>>(),
            .range = range,
            .unit = unit,
            .meaning = meaning_of<Plain<T>>(meaning),
            .required = (rule & required) != 0,
            .by_default = {},
            .takes_diameters =
                unit == std::string_view("m") && form_of<Plain<T>>().of != Form::Of::list,
            .fixed_by_restart = (rule & fixed_by_restart) != 0,
            .read =
                [get = get_, member, range](const Node& node, Config& config, std::size_t entry) {
                  Plain<T> value{};
                  Mismatch mismatch = convert(node, value);
                  if (!mismatch) mismatch = check(value, range);
                  if (!mismatch) parent_of(get, config, entry)->*member = value;
                  return mismatch;
                },
            .text = [get = get_, member](const Config& config,
                                         std::size_t entry) -> std::optional<std::string> {
              const Struct* parent = parent_of(get, config, entry);
              if (parent == nullptr) return {};
              return optional_text(parent->*member);
            }});
    return section_.keys.back();
  }

 private:
  Section& section_;
  Get get_;
};

/// Builder of a section that may be written many times, [[name]]: keys are members of the entries
/// of a list. `list`: from a Config to a pointer to the std::vector of them, nullptr where that is
/// absent.
template <class List>
auto repeated_keys(Section& section, List list) {
  section.append = [list](Config& c) {
    if (auto* entries = list(c); entries != nullptr) entries->emplace_back();
  };
  section.count = [list](const Config& c) {
    const auto* entries = list(c);
    return entries != nullptr ? entries->size() : 0;
  };
  return Keys(section, [list](auto& c, std::size_t entry) {
    auto* entries = list(c);
    return entries != nullptr && entry < entries->size() ? entries->data() + entry : nullptr;
  });
}

}  // namespace barchan
